// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "chain_tracker/chain/chain_layout.h"

namespace chain_tracker {
namespace {

double distanceToEdge(const cv::Point2d& point, const cv::Point2d& a, const cv::Point2d& b) {
  const cv::Point2d edge = b - a;
  const double along = std::clamp((point - a).dot(edge) / edge.dot(edge), 0.0, 1.0);
  return cv::norm(point - (a + along * edge));
}

/// Distance to the line through the points; negative inside, if it is closed.
double signedDistance(const Silhouette& silhouette, const cv::Point2d& point) {
  const std::vector<cv::Point2d>& points = silhouette.points;
  const bool closed = silhouette.stroke == 0.0;
  double distance = 1e9;
  bool inside = false;
  for (size_t i = closed ? 0 : 1; i < points.size(); ++i) {
    const cv::Point2d& a = points[(i + points.size() - 1) % points.size()];
    const cv::Point2d& b = points[i];
    distance = std::min(distance, distanceToEdge(point, a, b));
    const bool crosses = (a.y > point.y) != (b.y > point.y) &&
                         point.x < (b.x - a.x) * (point.y - a.y) / (b.y - a.y) + a.x;
    inside = inside != crosses;
  }
  return closed && inside ? -distance : distance;
}

/// The mask must hold all pixels nearer than the margin and none farther, but for what rounding the
/// outline to whole pixels moves.
void expectMask(const Silhouette& silhouette, const cv::Size& size, double margin) {
  constexpr double kBlur = 1.6;  // [px]
  SCOPED_TRACE("margin " + std::to_string(margin));
  const cv::Mat1b mask = maskOf(silhouette, {{}, size}, margin);
  ASSERT_EQ(size, mask.size());
  const double reach = margin + 0.5 * silhouette.stroke;
  int on = 0;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      ASSERT_TRUE(mask(y, x) == 0 || mask(y, x) == 255);
      const double distance = signedDistance(silhouette, cv::Point2d(x, y));
      if (distance < reach - kBlur) {
        ASSERT_EQ(255, mask(y, x)) << "inside at " << cv::Point(x, y);
      }
      if (distance > reach + kBlur) {
        ASSERT_EQ(0, mask(y, x)) << "outside at " << cv::Point(x, y);
      }
      on += mask(y, x) != 0;
    }
  }
  EXPECT_GT(on, 0);
}

TEST(MaskOf, coversAPolygonAndItsMargin) {
  const Silhouette polygon{{{30.2, 20.7}, {90.0, 35.0}, {80.0, 75.0}, {20.0, 60.0}}, 0.0};
  for (double margin : {0.0, 1.0, 4.5, 12.0, 100.0}) expectMask(polygon, {120, 100}, margin);
}

TEST(MaskOf, coversTheStrokeOfAPolylineAndItsMargin) {
  const Silhouette polyline{{{20.0, 20.0}, {90.0, 30.0}, {60.0, 80.0}}, 7.0};
  for (double margin : {0.0, 1.0, 5.0, 12.0}) expectMask(polyline, {120, 100}, margin);
}

TEST(MaskOf, endsAtTheImagesBorder) {
  const Silhouette polygon{{{-40.0, 20.0}, {60.0, -30.0}, {200.0, 75.0}, {20.0, 160.0}}, 0.0};
  expectMask(polygon, {120, 100}, 0.0);
  expectMask(polygon, {120, 100}, 6.0);
}

TEST(MaskOf, isEmptyForATargetOutsideTheImage) {
  const Silhouette polygon{{{-40.0, -40.0}, {-20.0, -40.0}, {-20.0, -20.0}, {-40.0, -20.0}}, 0.0};
  EXPECT_EQ(0, cv::countNonZero(maskOf(polygon, {0, 0, 50, 50}, 5.0)));
}

TEST(LayOutSilhouette, isTheRectangleGiven) {
  ChainModel model;
  model.segments[0].layout = Layout::kPlanar;
  const std::vector<cv::Point2d> corners = {{30, 20}, {90, 20}, {90, 60}, {30, 60}};
  const Silhouette silhouette = layOut(model, corners).silhouette;
  EXPECT_EQ(0.0, silhouette.stroke);
  ASSERT_EQ(4U, silhouette.points.size());
  for (size_t i = 0; i < 4; ++i) EXPECT_LT(cv::norm(silhouette.points[i] - corners[i]), 1e-9);
}

TEST(LayOutSilhouette, isTheRectangleAroundTwoEnds) {
  ChainModel model;
  model.segments[0].layout = Layout::kElongated;
  model.segments[0].aspect = 0.5;
  const Silhouette silhouette = layOut(model, {{50, 10}, {50, 110}}).silhouette;
  const cv::Rect2d bounds = uprightBounds(silhouette.points);
  EXPECT_NEAR(25.0, bounds.x, 1e-9);
  EXPECT_NEAR(10.0, bounds.y, 1e-9);
  EXPECT_NEAR(50.0, bounds.width, 1e-9);
  EXPECT_NEAR(100.0, bounds.height, 1e-9);
}

TEST(LayOutSilhouette, isAsWideAsTheAspectOfAPolylineSays) {
  ChainModel model;
  model.segments[0].layout = Layout::kDeformable;
  model.segments[0].aspect = 0.1;
  const std::vector<cv::Point2d> polyline = {{10, 10}, {70, 10}, {70, 50}};
  const Silhouette silhouette = layOut(model, polyline).silhouette;
  EXPECT_NEAR(10.0, silhouette.stroke, 1e-9);
  EXPECT_EQ(polyline, silhouette.points);
}

}  // namespace
}  // namespace chain_tracker
