// SPDX-License-Identifier: BSD-3-Clause
#include "chain/state_motion.h"

#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

/// Two segments of two parts.
ChainState someState() {
  ChainState state;
  state.parts.resize(4);
  state.parts[0].position = {10.0, 20.0};
  state.parts[1].position = {30.0, 20.0};
  state.parts[1].orientation = 3.0;
  state.parts[2].position = {10.0, 40.0};
  state.parts[3].position = {30.0, 40.0};
  state.segments.resize(2);
  state.segments[0].part_count = state.segments[1].part_count = 2;
  state.segments[1].first_part = 2;
  state.segments[0].image_from_segment = {0.25, 1.5, {40.0, 30.0}};
  return state;
}

TEST(MiddleOf, isTheMeanOfTheParts) { EXPECT_EQ(cv::Point2d(20.0, 30.0), middleOf(someState())); }

TEST(ExtentOf, addsTheSegments) {
  ChainState state = someState();
  EXPECT_NEAR(20.0 + 20.0, extentOf(state), 1e-9);
  state.parts[3].position = {30.0, 61.0};
  EXPECT_NEAR(20.0 + 29.0, extentOf(state), 1e-9);
}

TEST(RigidMotion, takesItsCentreToItsTarget) {
  const Similarity motion = rigidMotion(CV_PI / 2.0, {3.0, 4.0}, {10.0, 20.0});
  EXPECT_NEAR(0.0, cv::norm(motion.apply({3.0, 4.0}) - cv::Point2d(10.0, 20.0)), 1e-9);
  EXPECT_NEAR(0.0, cv::norm(motion.apply({4.0, 4.0}) - cv::Point2d(10.0, 21.0)), 1e-9);
}

TEST(TurnWhole, keepsTheMiddleAndTurnsTheRest) {
  ChainState state = someState();
  turnWhole(CV_PI / 2.0, state);
  EXPECT_NEAR(0.0, cv::norm(state.parts[0].position - cv::Point2d(30.0, 20.0)), 1e-9);
  EXPECT_NEAR(0.0, cv::norm(state.parts[3].position - cv::Point2d(10.0, 40.0)), 1e-9);
  EXPECT_NEAR(wrapAngle(3.0 + CV_PI / 2.0), state.parts[1].orientation, 1e-9);
  const Similarity& pose = state.segments[0].image_from_segment;
  EXPECT_NEAR(0.25 + CV_PI / 2.0, pose.angle, 1e-9);
  EXPECT_EQ(1.5, pose.scale);
  EXPECT_NEAR(0.0, cv::norm(pose.translation - cv::Point2d(20.0, 50.0)), 1e-9);
}

TEST(MoveSegment, leavesTheOthers) {
  ChainState state = someState();
  moveSegment(rigidMotion(0.0, {0.0, 0.0}, {5.0, -5.0}), 1, state);
  EXPECT_EQ(cv::Point2d(30.0, 20.0), state.parts[1].position);
  EXPECT_EQ(cv::Point2d(15.0, 35.0), state.parts[2].position);
  EXPECT_EQ(cv::Point2d(5.0, -5.0), state.segments[1].image_from_segment.translation);
  EXPECT_EQ(cv::Point2d(40.0, 30.0), state.segments[0].image_from_segment.translation);
}

}  // namespace
}  // namespace chain_tracker
