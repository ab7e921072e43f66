// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/link_width.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace chain_tracker {
namespace {

using Polyline = std::vector<cv::Point2d>;

const Polyline kArm = {{100, 60}, {180, 120}, {180, 220}};  // two links of 100 px
/// What the links' cells cover of their width.
constexpr double kCovered = 0.85;

/// Green clutter.
cv::Mat3b meadow() {
  cv::Mat3b image(300, 320);
  cv::RNG random(3);
  random.fill(image, cv::RNG::NORMAL, cv::Scalar(40, 120, 60), cv::Scalar(12, 20, 12));
  return image;
}

void drawLink(const cv::Point2d& from, const cv::Point2d& to, double width, const cv::Scalar& color,
              cv::Mat3b& image) {
  const cv::Point2d along = to - from;
  const cv::Point2d aside = cv::Point2d(-along.y, along.x) * (0.5 * width / cv::norm(along));
  std::vector<cv::Point> corners;
  for (const cv::Point2d& corner : {from + aside, to + aside, to - aside, from - aside}) {
    corners.emplace_back(corner);
  }
  cv::fillConvexPoly(image, corners, color);
}

cv::Mat3b drawnArm(double upper_width, double lower_width,
                   const cv::Scalar& color = {60, 90, 200}) {
  cv::Mat3b image = meadow();
  drawLink(kArm[0], kArm[1], upper_width, color, image);
  drawLink(kArm[1], kArm[2], lower_width, color, image);
  return image;
}

cv::Mat1b greyOf(const cv::Mat3b& image) {
  cv::Mat1b grey;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

TEST(MeasureAspects, tellsTheWidthOfLinks) {
  for (const double width : {20.0, 30.0, 44.0}) {
    for (const double aspect : measureAspects(drawnArm(width, width), kArm)) {
      EXPECT_NEAR(kCovered * width / 100.0, aspect, 0.02) << "drawn " << width << " px wide";
    }
    EXPECT_EQ(2U, measureAspects(drawnArm(width, width), kArm).size());
  }
}

TEST(MeasureAspects, worksOnMonoImages) {
  const cv::Mat1b image = greyOf(drawnArm(30.0, 30.0, {220, 220, 220}));
  const std::vector<double> aspects = measureAspects(image, kArm);
  ASSERT_EQ(2U, aspects.size());
  for (const double aspect : aspects) EXPECT_NEAR(kCovered * 0.3, aspect, 0.02);
}

TEST(MeasureAspects, drawsLinksTowardsOneAnother) {
  const std::vector<double> aspects = measureAspects(drawnArm(24.0, 40.0), kArm);
  ASSERT_EQ(2U, aspects.size());
  EXPECT_LT(aspects[0], aspects[1]);
  EXPECT_GT(aspects[0], kCovered * 0.24);
  EXPECT_LT(aspects[1], kCovered * 0.40);
}

TEST(MeasureAspects, toleratesANeighbourOfTheSameColours) {
  cv::Mat3b image = drawnArm(24.0, 24.0);
  image(cv::Rect(180, 130, 60, 90)).setTo(cv::Scalar(60, 90, 200));  // a torso beside one link
  const std::vector<double> aspects = measureAspects(image, kArm);
  ASSERT_EQ(2U, aspects.size());
  for (const double aspect : aspects) {
    EXPECT_GT(aspect, kCovered * 0.20);
    EXPECT_LT(aspect, kCovered * 0.36);
  }
}

TEST(MeasureAspects, staysInTheRangeOfCells) {
  for (const double aspect : measureAspects(drawnArm(6.0, 6.0), kArm)) EXPECT_EQ(0.14, aspect);
  for (const double aspect : measureAspects(drawnArm(80.0, 80.0), kArm)) EXPECT_EQ(0.5, aspect);
}

TEST(MeasureAspects, isEmptyWhereNothingStandsOut) {
  EXPECT_TRUE(measureAspects(cv::Mat3b(300, 320, cv::Vec3b(40, 120, 60)), kArm).empty());
}

TEST(MeasureAspects, toleratesAPolylineThatLeavesTheImage) {
  const Polyline leaving = {{140, 100}, {240, 100}, {340, 100}};
  cv::Mat3b image = meadow();
  drawLink({140, 100}, {340, 100}, 24.0, {60, 90, 200}, image);
  const std::vector<double> aspects = measureAspects(image, leaving);
  ASSERT_EQ(2U, aspects.size());
  for (const double aspect : aspects) EXPECT_NEAR(kCovered * 0.24, aspect, 0.02);
}

TEST(MeasureAspects, isEmptyOutsideTheImage) {
  EXPECT_TRUE(measureAspects(meadow(), {{900, 100}, {960, 100}, {1020, 100}}).empty());
}

TEST(WithMeasuredAspects, changesOnlySegmentsThatAskForIt) {
  ChainModel model;
  model.segments.resize(2);
  model.segments[0].aspect = model.segments[1].aspect = 0.4;
  const cv::Mat3b image = drawnArm(24.0, 24.0);
  EXPECT_EQ(0.4, withMeasuredAspects(model, image, kArm).segments[1].aspect);
  model.segments[1].measure_aspect = true;
  const ChainModel measured = withMeasuredAspects(model, image, kArm);
  EXPECT_EQ(0.4, measured.segments[0].aspect);
  EXPECT_NEAR(kCovered * 0.24, measured.segments[1].aspect, 0.02);
}

TEST(WithMeasuredAspects, needsASegmentForEveryEdge) {
  ChainModel model;
  model.segments.resize(1);
  model.segments[0].measure_aspect = true;
  model.segments[0].aspect = 0.4;
  EXPECT_EQ(0.4, withMeasuredAspects(model, drawnArm(24.0, 24.0), kArm).segments[0].aspect);
}

}  // namespace
}  // namespace chain_tracker
