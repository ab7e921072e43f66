// SPDX-License-Identifier: BSD-3-Clause
/// Occlusions and recoveries of made-up runs, counted by hand; an object of 100 px, so that it is
/// found within 10 px.
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "chain_tracker/evaluation/metrics.h"

namespace chain_tracker {
namespace {

constexpr int kPoints = 20;
constexpr double kFound = 10.0;
constexpr double kMissed = 10.5;

FrameScore frameWith(int hidden, double error) {
  FrameScore frame;
  frame.hidden_points = hidden;
  frame.point_errors.assign(kPoints - hidden, error);
  return frame;
}

using Frames = std::vector<FrameScore>;

Frames times(int count, const FrameScore& frame) {
  return Frames(static_cast<size_t>(count), frame);
}

Scores scoresOf(const std::vector<Frames>& runs) {
  Frames all;
  for (const Frames& run : runs) all.insert(all.end(), run.begin(), run.end());
  return summarize(all, 100.0, {});
}

void expectRecovery(const Scores& scores, int occlusions, int recovered) {
  EXPECT_EQ(scores.occlusions, occlusions);
  EXPECT_EQ(scores.occlusions_recovered, recovered);
}

const Frames kHidden = times(3, frameWith(15, 90.0));

TEST(OcclusionRecovery, CountsWhatIsFoundAfterwards) {
  expectRecovery(scoresOf({kHidden, times(10, frameWith(0, kFound))}), 1, 1);
  expectRecovery(scoresOf({kHidden, times(10, frameWith(0, kMissed))}), 1, 0);
}

TEST(OcclusionRecovery, TenFramesAreLeftToFindIt) {
  expectRecovery(scoresOf({kHidden, times(9, frameWith(0, kMissed)), {frameWith(0, kFound)}}), 1,
                 1);
  expectRecovery(
      scoresOf({kHidden, times(10, frameWith(0, kMissed)), times(9, frameWith(0, kFound))}), 1, 0);
}

TEST(OcclusionRecovery, NothingIsToldByWhatIsCutShort) {
  const Frames nine = times(9, frameWith(0, kFound));
  expectRecovery(scoresOf({kHidden, nine}), 0, 0);
  expectRecovery(scoresOf({kHidden, nine, kHidden, times(10, frameWith(0, kFound))}), 1, 1);
}

TEST(OcclusionRecovery, NeedsMoreThanAThirdHidden) {
  const Frames out = times(10, frameWith(0, kFound));
  expectRecovery(scoresOf({{frameWith(6, 1.0)}, out}), 0, 0);
  expectRecovery(scoresOf({{frameWith(7, 1.0)}, out}), 1, 1);
}

TEST(OcclusionRecovery, IsOverWhenATenthIsHidden) {
  const Frames partly = times(20, frameWith(3, kMissed));
  expectRecovery(scoresOf({kHidden, partly, times(10, frameWith(2, kFound))}), 1, 1);
  expectRecovery(scoresOf({kHidden, partly}), 0, 0);
}

TEST(OcclusionRecovery, WhatIsLostIsNotFound) {
  FrameScore lost = frameWith(0, std::numeric_limits<double>::infinity());
  lost.lost = true;
  expectRecovery(scoresOf({kHidden, times(10, lost)}), 1, 0);
}

TEST(OcclusionRecovery, FramesWithoutTruePointsArePassedOver) {
  const Frames unknown = times(30, FrameScore());
  expectRecovery(
      scoresOf({kHidden, times(5, frameWith(0, kMissed)), unknown, times(5, frameWith(0, kFound))}),
      1, 1);
}

}  // namespace
}  // namespace chain_tracker
