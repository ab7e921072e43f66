// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/ros/msg_conversion.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

PartState part(double x, double y) {
  PartState part;
  part.position = {x, y};
  part.orientation = 0.25;
  part.side = 12.0;
  part.confidence = 0.75;
  part.visible = true;
  part.covariance = cv::Matx22d(4.0, 1.0, 1.0, 9.0);
  return part;
}

/// An arm of 3 parts and a hand of 1.
ChainState armState() {
  ChainState state;
  state.status = TrackingStatus::kTracking;
  state.confidence = 0.5;
  state.parts = {part(10.0, 20.0), part(20.0, 20.0), part(30.0, 20.0), part(40.0, 40.0)};
  state.parts[3].visible = false;
  state.parts[3].covariance = cv::Matx22d::all(kNaN);
  state.segments = {{"arm", {0.1, 1.0, {20.0, 20.0}}, 0.6, 0, 3},
                    {"hand", {0.5, 2.0, {40.0, 40.0}}, 0.2, 3, 1}};
  state.points = {{{10.0, 20.0}, 0.7, true}, {{40.0, 40.0}, 0.2, false}};
  state.outline = {{5.0, 10.0}, {45.0, 10.0}, {45.0, 50.0}, {5.0, 50.0}};
  state.box = uprightBounds(state.outline);
  return state;
}

TrackedObject armMsg(const ChainState& state) { return toMsg(state, "left", "robot", {640, 480}); }

TEST(MsgConversion, KeepsIdentityStateAndConfidence) {
  const TrackedObject object = armMsg(armState());
  EXPECT_EQ(object.id, "left");
  EXPECT_EQ(object.model, "robot");
  EXPECT_EQ(object.state, TrackedObject::TRACKING);
  EXPECT_FLOAT_EQ(object.confidence, 0.5f);
}

TEST(MsgConversion, MapsEveryState) {
  const std::vector<std::pair<TrackingStatus, int>> states = {
      {TrackingStatus::kInitializing, TrackedObject::INITIALIZING},
      {TrackingStatus::kTracking, TrackedObject::TRACKING},
      {TrackingStatus::kOccluded, TrackedObject::OCCLUDED},
      {TrackingStatus::kLost, TrackedObject::LOST}};
  for (const auto& [status, expected] : states) {
    ChainState state = armState();
    state.status = status;
    EXPECT_EQ(armMsg(state).state, expected);
  }
}

TEST(MsgConversion, KeepsThePartsInTheirOrder) {
  const TrackedObject object = armMsg(armState());
  ASSERT_EQ(object.parts.size(), 4u);
  EXPECT_EQ(object.parts[0].name, "arm/0");
  EXPECT_EQ(object.parts[2].name, "arm/2");
  EXPECT_EQ(object.parts[3].name, "hand/0");
  EXPECT_EQ(object.parts[1].pose.x, 20.0);
  EXPECT_EQ(object.parts[1].pose.y, 20.0);
  EXPECT_EQ(object.parts[1].pose.theta, 0.25);
  EXPECT_EQ(object.parts[1].size, 12.0f);
  EXPECT_EQ(object.parts[1].confidence, 0.75f);
  EXPECT_TRUE(object.parts[1].visible);
  EXPECT_FALSE(object.parts[3].visible);
}

TEST(MsgConversion, SaysWhatIsUnknown) {
  const TrackedObject object = armMsg(armState());
  EXPECT_EQ(object.parts[0].covariance[0], 4.0f);
  EXPECT_EQ(object.parts[0].covariance[1], 1.0f);
  EXPECT_EQ(object.parts[0].covariance[3], 9.0f);
  EXPECT_EQ(object.parts[3].covariance[0], -1.0f);
  EXPECT_TRUE(std::isnan(object.parts[0].position.x));
  EXPECT_TRUE(std::isnan(object.parts[0].position.z));
}

TEST(MsgConversion, KeepsTheSegments) {
  const TrackedObject object = armMsg(armState());
  ASSERT_EQ(object.segments.size(), 2u);
  EXPECT_EQ(object.segments[1].name, "hand");
  EXPECT_EQ(object.segments[1].first_part, 3u);
  EXPECT_EQ(object.segments[1].part_count, 1u);
  EXPECT_EQ(object.segments[1].scale, 2.0f);
  EXPECT_EQ(object.segments[1].pose.x, 40.0);
  EXPECT_EQ(object.segments[1].pose.theta, 0.5);
}

TEST(MsgConversion, TheObjectsPoseIsTheMeanWeightedByParts) {
  const TrackedObject object = armMsg(armState());
  EXPECT_DOUBLE_EQ(object.pose.x, (3 * 20.0 + 40.0) / 4);
  EXPECT_DOUBLE_EQ(object.pose.y, (3 * 20.0 + 40.0) / 4);
  EXPECT_NEAR(object.pose.theta,
              std::atan2(3 * std::sin(0.1) + std::sin(0.5), 3 * std::cos(0.1) + std::cos(0.5)),
              1e-12);
  EXPECT_FLOAT_EQ(object.scale, static_cast<float>(std::pow(2.0, 0.25)));
}

TEST(MsgConversion, AnglesAreAveragedOnTheCircle) {
  ChainState state = armState();
  state.segments[0].part_count = 2;
  state.segments[1] = {"hand", {-kPi + 0.2, 1.0, {}}, 0.2, 2, 2};
  state.segments[0].image_from_segment.angle = kPi - 0.2;
  EXPECT_NEAR(std::abs(armMsg(state).pose.theta), kPi, 1e-9);
}

TEST(MsgConversion, KeepsPointsAndOutline) {
  const TrackedObject object = armMsg(armState());
  ASSERT_EQ(object.points.size(), 2u);
  EXPECT_EQ(object.points[1].x, 40.0f);
  EXPECT_EQ(object.points[1].confidence, 0.2f);
  EXPECT_FALSE(object.points[1].visible);
  ASSERT_EQ(object.outline.points.size(), 4u);
  EXPECT_EQ(object.outline.points[2].x, 45.0f);
  EXPECT_EQ(object.outline.points[2].y, 50.0f);
}

TEST(MsgConversion, TheBoxMayTurnLessThanTheOutline) {
  ChainState state = armState();
  state.box = {5.25, 10.5, 40.0, 30.0};
  const TrackedObject object = armMsg(state);
  EXPECT_EQ(object.box[0], 5.25);
  EXPECT_EQ(object.box[1], 10.5);
  EXPECT_EQ(object.box[2], 40.0);
  EXPECT_EQ(object.box[3], 30.0);
}

struct Box {
  cv::Rect2d given;
  cv::Rect expected;
};

class Region : public testing::TestWithParam<Box> {};

TEST_P(Region, IsTheOutlinesBoundsCutToTheImage) {
  ChainState state = armState();
  const cv::Point2d low = GetParam().given.tl();
  const cv::Point2d high = GetParam().given.br();
  state.outline = {{low.x, high.y}, low, {high.x, low.y}, high};
  const sensor_msgs::RegionOfInterest roi = armMsg(state).roi;
  const cv::Rect& expected = GetParam().expected;
  EXPECT_EQ(roi.x_offset, static_cast<unsigned>(expected.x));
  EXPECT_EQ(roi.y_offset, static_cast<unsigned>(expected.y));
  EXPECT_EQ(roi.width, static_cast<unsigned>(expected.width));
  EXPECT_EQ(roi.height, static_cast<unsigned>(expected.height));
}

INSTANTIATE_TEST_SUITE_P(All, Region,
                         testing::Values(Box{{5.2, 10.4, 40.0, 40.0}, {5, 10, 40, 40}},
                                         Box{{-20.0, -30.0, 50.0, 50.0}, {0, 0, 30, 20}},
                                         Box{{600.0, 470.0, 100.0, 100.0}, {600, 470, 40, 10}},
                                         Box{{700.0, 100.0, 50.0, 50.0}, {0, 0, 0, 0}},
                                         Box{{-1e12, -1e12, 2e12, 2e12}, {0, 0, 640, 480}}));

TEST(MsgConversion, ALostObjectRepeatsNoPosition) {
  ChainState state = armState();
  state.status = TrackingStatus::kLost;
  const TrackedObject object = armMsg(state);
  EXPECT_EQ(object.state, TrackedObject::LOST);
  EXPECT_FLOAT_EQ(object.confidence, 0.5f);
  EXPECT_TRUE(std::isnan(object.pose.x));
  EXPECT_TRUE(std::isnan(object.scale));
  EXPECT_TRUE(object.outline.points.empty());
  EXPECT_TRUE(std::isnan(object.box[0]));
  EXPECT_EQ(object.roi.width, 0u);
  ASSERT_EQ(object.parts.size(), 4u);
  for (const PartPose& part : object.parts) {
    EXPECT_TRUE(std::isnan(part.pose.x));
    EXPECT_FALSE(part.visible);
    EXPECT_EQ(part.confidence, 0.0f);
    EXPECT_EQ(part.covariance[0], -1.0f);
  }
  for (const SegmentPose& segment : object.segments) {
    EXPECT_TRUE(std::isnan(segment.pose.y));
    EXPECT_EQ(segment.confidence, 0.0f);
  }
  for (const TrackedPoint& point : object.points) {
    EXPECT_TRUE(std::isnan(point.x));
    EXPECT_FALSE(point.visible);
    EXPECT_EQ(point.confidence, 0.0f);
  }
}

}  // namespace
}  // namespace chain_tracker
