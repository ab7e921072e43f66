// SPDX-License-Identifier: BSD-3-Clause
#include "chain/lost_search.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

TEST(SoughtTurn, isNoneWhileTrackedAndInEveryOtherFrame) {
  for (const int frames_lost : {0, 1, 3, 5, 27}) {
    EXPECT_EQ(0.0, soughtTurn(SegmentModel(), frames_lost)) << frames_lost;
  }
}

/// However few or many hypotheses there are: some turn lies within half of what they cover.
TEST(SoughtTurn, comesNearEveryOrientation) {
  for (const int hypotheses : {1, 3, 5, 9, 63, 99}) {
    SegmentModel model;
    model.orientation_hypotheses = hypotheses;
    const double covered = std::max(0.4, hypotheses * model.orientation_step);
    for (double orientation = -3.1; orientation < 3.2; orientation += 0.05) {
      double nearest = CV_PI;
      for (int frames_lost = 1; frames_lost <= 2 * 16; ++frames_lost) {
        const double turn = soughtTurn(model, frames_lost);
        nearest = std::min(nearest, std::abs(wrapAngle(orientation - turn)));
      }
      EXPECT_LE(nearest, 0.5 * covered + 1e-9) << hypotheses << " at " << orientation;
    }
  }
}

TEST(SoughtTurn, nearerOrientationsComeFirst) {
  double before = 0.0;
  for (int frames_lost = 2; frames_lost <= 24; frames_lost += 2) {
    const double turn = std::abs(wrapAngle(soughtTurn(SegmentModel(), frames_lost)));
    EXPECT_GE(turn, before - 1e-9) << frames_lost;
    EXPECT_GT(turn, 0.0) << frames_lost;
    before = turn;
  }
}

TEST(TurnAboutMiddle, keepsTheMiddleAndTurnsTheRest) {
  ChainState state;
  state.parts.resize(2);
  state.parts[0].position = {10.0, 20.0};
  state.parts[1].position = {30.0, 20.0};
  state.parts[1].orientation = 3.0;
  state.segments.resize(1);
  state.segments[0].image_from_segment = {0.25, 1.5, {40.0, 20.0}};
  turnAboutMiddle(CV_PI / 2.0, state);
  EXPECT_NEAR(0.0, cv::norm(state.parts[0].position - cv::Point2d(20.0, 10.0)), 1e-9);
  EXPECT_NEAR(0.0, cv::norm(state.parts[1].position - cv::Point2d(20.0, 30.0)), 1e-9);
  EXPECT_NEAR(wrapAngle(3.0 + CV_PI / 2.0), state.parts[1].orientation, 1e-9);
  const Similarity& pose = state.segments[0].image_from_segment;
  EXPECT_NEAR(0.25 + CV_PI / 2.0, pose.angle, 1e-9);
  EXPECT_EQ(1.5, pose.scale);
  EXPECT_NEAR(0.0, cv::norm(pose.translation - cv::Point2d(20.0, 40.0)), 1e-9);
}

}  // namespace
}  // namespace chain_tracker
