// SPDX-License-Identifier: BSD-3-Clause
#include "chain/texture_weight.h"

#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "support/drawn_swimmer.h"

namespace chain_tracker {
namespace {

using Polyline = std::vector<cv::Point2d>;

const Polyline kLine = {{50.0, 120.0}, {350.0, 120.0}};
constexpr double kWeight = 3.0;

/// 16 windows of `side` px along kLine.
ChainModel lineModel(double side) {
  ChainModel model;
  SegmentModel& segment = model.segments[0];
  segment.layout = Layout::kDeformable;
  segment.parts = 16;
  segment.window = side / 20.0;
  segment.orientation_hypotheses = segment.scale_hypotheses = 1;
  model.appearance.haar_weight = kWeight;
  return model;
}

/// What kLine is the middle of, in bands of two greys.
cv::Mat3b drawn(int thickness, int bands = 1) {
  cv::RNG random(7);
  cv::Mat3b image = clutteredGround(random);
  for (int i = 0; i < bands; ++i) {
    const cv::Rect band(40 + 320 * i / bands, 120 - thickness / 2, 320 / bands, thickness);
    image(band).setTo(cv::Scalar::all(i % 2 == 0 ? 40 : 90));
  }
  return image;
}

double weightOf(const ChainModel& model, const cv::Mat& image, const Polyline& points = kLine) {
  const ChainLayout layout = layOut(model, points);
  ObjectAppearance learned(image, layout, model.appearance);
  return withMeasuredTexture(model.appearance, layout, learned).haar_weight;
}

TEST(WithMeasuredTexture, countsItMoreOnAFlatBody) {
  EXPECT_EQ(4.0 * kWeight, weightOf(lineModel(20.0), drawn(40)));
}

TEST(WithMeasuredTexture, countsItAsUsualOnAThread) {
  EXPECT_EQ(kWeight, weightOf(lineModel(20.0), drawn(6)));
}

TEST(WithMeasuredTexture, countsItAsUsualInSmallWindowsWithinSomethingThin) {
  EXPECT_EQ(kWeight, weightOf(lineModel(10.0), drawn(16)));
}

TEST(WithMeasuredTexture, countsItAsUsualOnAMarkedBody) {
  EXPECT_EQ(kWeight, weightOf(lineModel(20.0), drawn(40, 32)));
}

TEST(WithMeasuredTexture, countsItAsUsualOnWhatKeepsItsShape) {
  ChainModel model = lineModel(20.0);
  model.segments[0].layout = Layout::kElongated;
  EXPECT_EQ(kWeight, weightOf(model, drawn(200)));
}

TEST(WithMeasuredTexture, asksAllSegments) {
  ChainModel model = lineModel(20.0);
  model.segments.push_back(model.segments[0]);
  model.joints.resize(1);
  const Polyline points = {{50.0, 120.0}, {200.0, 120.0}, {350.0, 120.0}};
  EXPECT_EQ(4.0 * kWeight, weightOf(model, drawn(40), points));
  model.segments[1].layout = Layout::kElongated;
  EXPECT_EQ(kWeight, weightOf(model, drawn(40), points));
}

/// Half of it lies beyond the image, of which nothing is known: not that it is flat.
TEST(WithMeasuredTexture, leavesOutWhatIsNotSeen) {
  const Polyline points = {{0.0, 120.0}, {600.0, 120.0}};
  ChainModel model = lineModel(20.0);
  model.segments[0].parts = 31;
  EXPECT_EQ(kWeight, weightOf(model, drawn(40, 32), points));
}

/// With texture as usual it contracts while it bends.
TEST(WithMeasuredTexture, followsAWormMoreClosely) {
  ChainModel model = lineModel(20.0);
  model.segments[0].parts = 48;
  model.segments[0].measure_window = true;
  model.appearance.haar_weight = AppearanceModel().haar_weight;
  ChainModel usual = model;
  usual.appearance.haar_weight /= 4.0;
  const DrawnSwimmer worm = DrawnSwimmer::worm();
  EXPECT_LT(errorOfMidline(model, worm), 0.75 * errorOfMidline(usual, worm));
}

}  // namespace
}  // namespace chain_tracker
