// SPDX-License-Identifier: BSD-3-Clause
#include "chain/line_width.h"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "support/drawn_swimmer.h"

namespace chain_tracker {
namespace {

using Polyline = std::vector<cv::Point2d>;

cv::Mat3b drawn(const Polyline& line, double thickness, const cv::Scalar& color = {60, 40, 30}) {
  cv::RNG random(7);
  cv::Mat3b image = clutteredGround(random);
  std::vector<cv::Point> points(line.begin(), line.end());
  cv::polylines(image, points, false, color, cvRound(thickness));
  return image;
}

/// A quarter of a circle of 300 px.
Polyline arc() {
  constexpr double kRadius = 600.0 / CV_PI;
  Polyline line;
  for (int i = 0; i <= 30; ++i) {
    const double angle = -CV_PI * (0.25 + 0.5 * i / 30.0);
    line.push_back(cv::Point2d(200.0, 250.0) +
                   kRadius * cv::Point2d(std::cos(angle), std::sin(angle)));
  }
  return line;
}

const Polyline kStraight = {{50.0, 120.0}, {200.0, 125.0}, {350.0, 130.0}};

TEST(MeasureThickness, tellsThatOfStraightAndBentLines) {
  for (const Polyline& line : {kStraight, arc()}) {
    for (const double thickness : {5.0, 13.0, 31.0, 51.0}) {
      EXPECT_NEAR(thickness, measureThickness(drawn(line, thickness), line), 2.5);
    }
  }
}

TEST(MeasureThickness, worksOnMonoImages) {
  cv::Mat1b grey;
  cv::cvtColor(drawn(kStraight, 31.0), grey, cv::COLOR_BGR2GRAY);
  EXPECT_NEAR(31.0, measureThickness(grey, kStraight), 2.5);
}

TEST(MeasureThickness, toleratesALineBesideTheMiddle) {
  Polyline beside = kStraight;
  for (cv::Point2d& point : beside) point.y += 5.0;
  EXPECT_NEAR(31.0, measureThickness(drawn(kStraight, 31.0), beside), 2.5);
}

TEST(MeasureThickness, isNoneWhereNothingStandsOut) {
  cv::RNG random(7);
  EXPECT_EQ(0.0, measureThickness(cv::Mat3b(240, 400, cv::Vec3b(60, 60, 60)), kStraight));
  EXPECT_LT(measureThickness(clutteredGround(random), kStraight), 5.0);
}

TEST(MeasureThickness, isNoneOutsideTheImage) {
  EXPECT_EQ(0.0, measureThickness(drawn(kStraight, 31.0), {{900.0, 120.0}, {980.0, 120.0}}));
}

TEST(MeasureThickness, isNoneOfWhatIsNoLine) {
  EXPECT_EQ(0.0, measureThickness(drawn(kStraight, 120.0), kStraight));
}

ChainModel lineModel() {
  ChainModel model;
  SegmentModel& segment = model.segments[0];
  segment.layout = Layout::kDeformable;
  segment.parts = 48;
  segment.window = 1.0;
  segment.measure_window = true;
  segment.orientation_hypotheses = segment.scale_hypotheses = 1;
  return model;
}

TEST(WithMeasuredWindows, widensTheWindowsOnSomethingThick) {
  const ChainModel model = withMeasuredWindows(lineModel(), drawn(kStraight, 40.0), kStraight);
  const SegmentModel& segment = model.segments[0];
  const double side = segment.window * 300.0 / (segment.parts - 1);
  EXPECT_NEAR(0.65 * 40.0, side, 2.0);
  EXPECT_NEAR(2.0, segment.window, 0.1);
}

TEST(WithMeasuredWindows, leavesWindowsThatAreWideEnough) {
  const ChainModel model = withMeasuredWindows(lineModel(), drawn(kStraight, 7.0), kStraight);
  EXPECT_EQ(48, model.segments[0].parts);
  EXPECT_EQ(1.0, model.segments[0].window);
}

TEST(WithMeasuredWindows, addsNoParts) {
  ChainModel few = lineModel();
  few.segments[0].parts = 10;
  few.segments[0].window = 0.3;
  const ChainModel model = withMeasuredWindows(few, drawn(kStraight, 20.0), kStraight);
  EXPECT_EQ(10, model.segments[0].parts);
  EXPECT_NEAR(0.65 * 20.0, model.segments[0].window * 300.0 / 9.0, 2.0);
}

TEST(WithMeasuredWindows, changesOnlyWhatAsksForIt) {
  ChainModel model = lineModel();
  model.segments[0].measure_window = false;
  EXPECT_EQ(48, withMeasuredWindows(model, drawn(kStraight, 40.0), kStraight).segments[0].parts);
}

TEST(WithMeasuredWindows, measuresEachJoinedSegment) {
  ChainModel model = lineModel();
  model.segments.push_back(model.segments[0]);
  model = withMeasuredWindows(model, drawn(kStraight, 30.0), kStraight);
  for (const SegmentModel& segment : model.segments) {
    EXPECT_NEAR(0.65 * 30.0, segment.window * 150.0 / (segment.parts - 1), 2.0);
  }
}

/// Its body looks the same all along: narrow windows within it would let the chain contract.
TEST(WithMeasuredWindows, followsTheMiddleOfAFish) {
  EXPECT_LT(errorOfMidline(lineModel(), DrawnSwimmer::fish()), 0.015 * DrawnSwimmer::kLength);
}

}  // namespace
}  // namespace chain_tracker
