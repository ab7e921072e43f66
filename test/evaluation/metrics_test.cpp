// SPDX-License-Identifier: BSD-3-Clause
/// Hand-computed cases of every figure.
#include "chain_tracker/evaluation/metrics.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

FrameScore seen(double overlap, double center_error) {
  FrameScore score;
  score.has_object = true;
  score.overlap = overlap;
  score.center_error = center_error;
  return score;
}

FrameScore lostFrame() {
  FrameScore score = seen(0.0, kInfinity);
  score.lost = true;
  return score;
}

TEST(Metrics, IntersectionOverUnion) {
  const cv::Rect2d a(0, 0, 10, 10);
  EXPECT_DOUBLE_EQ(intersectionOverUnion(a, a), 1.0);
  EXPECT_DOUBLE_EQ(intersectionOverUnion(a, {5, 0, 10, 10}), 50.0 / 150.0);
  EXPECT_DOUBLE_EQ(intersectionOverUnion(a, {2, 3, 4, 5}), 0.2) << "one inside the other";
  EXPECT_DOUBLE_EQ(intersectionOverUnion(a, {10, 0, 5, 5}), 0.0) << "touching";
  EXPECT_DOUBLE_EQ(intersectionOverUnion(a, {0, 0, 0, 0}), 0.0) << "empty";
}

TEST(Metrics, CenterDistance) {
  EXPECT_DOUBLE_EQ(centerDistance({0, 0, 10, 10}, {3, 4, 10, 10}), 5.0);
  EXPECT_DOUBLE_EQ(centerDistance({0, 0, 10, 10}, {3, 3, 4, 4}), 0.0);
}

TEST(Metrics, SuccessCountsOverlapsAboveTheThreshold) {
  const std::vector<double> curve = successCurve({0.0, 0.5, 0.52, 1.0});
  ASSERT_EQ(curve.size(), 21U);
  EXPECT_DOUBLE_EQ(curve[0], 0.75) << "above 0";
  EXPECT_DOUBLE_EQ(curve[9], 0.75) << "above 0.45";
  EXPECT_DOUBLE_EQ(curve[10], 0.5) << "above 0.5, itself not";
  EXPECT_DOUBLE_EQ(curve[11], 0.25) << "above 0.55";
  EXPECT_DOUBLE_EQ(curve[20], 0.0) << "nothing is above 1";
}

TEST(Metrics, SuccessAucIsTheMeanOfTheCurve) {
  EXPECT_DOUBLE_EQ(successAuc({1.0}), 20.0 / 21.0);
  EXPECT_DOUBLE_EQ(successAuc({0.0}), 0.0);
  EXPECT_DOUBLE_EQ(successAuc({0.52, 0.52}), 11.0 / 21.0) << "thresholds 0 to 0.5";
  EXPECT_TRUE(std::isnan(successAuc({})));
}

TEST(Metrics, WhatIsLostIsNeverWithinADistance) {
  const std::vector<double> distances = {0.0, 20.0, 20.5, kInfinity};
  EXPECT_DOUBLE_EQ(shareWithin(distances, 0.0), 0.25);
  EXPECT_DOUBLE_EQ(shareWithin(distances, 20.0), 0.5);
  EXPECT_DOUBLE_EQ(shareWithin(distances, 1e6), 0.75);
}

TEST(Metrics, PercentileInterpolatesBetweenOrderStatistics) {
  EXPECT_DOUBLE_EQ(percentile({5.0, 1.0, 3.0}, 0.5), 3.0);
  EXPECT_DOUBLE_EQ(percentile({1.0, 2.0}, 0.5), 1.5);
  EXPECT_DOUBLE_EQ(percentile({0.0, 100.0}, 0.99), 99.0);
  EXPECT_DOUBLE_EQ(percentile({4.0}, 0.99), 4.0);
  EXPECT_TRUE(std::isnan(percentile({}, 0.5)));
}

TEST(Metrics, FramesWithoutTruthDoNotCount) {
  const Scores scores = summarize({seen(0.8, 2.0), FrameScore(), seen(0.4, 30.0)}, 100.0, {2.0});
  EXPECT_EQ(scores.frames, 3);
  EXPECT_EQ(scores.scored_frames, 2);
  EXPECT_DOUBLE_EQ(scores.mean_iou, 0.6);
  EXPECT_DOUBLE_EQ(scores.pascal_50, 0.5);
  EXPECT_DOUBLE_EQ(scores.precision_20px, 0.5);
  EXPECT_DOUBLE_EQ(scores.mean_center_error_px, 16.0);
}

TEST(Metrics, PascalAsksForMoreThanHalf) {
  const Scores scores = summarize({seen(0.5, 1.0), seen(0.51, 1.0)}, 100.0, {});
  EXPECT_DOUBLE_EQ(scores.pascal_50, 0.5);
}

TEST(Metrics, WithoutTruthThereAreNoFigures) {
  const Scores scores = summarize({FrameScore(), FrameScore()}, 100.0, {2.0});
  EXPECT_EQ(scores.frames, 2);
  EXPECT_EQ(scores.scored_frames, 0);
  for (const double figure :
       {scores.mean_iou, scores.success_auc, scores.pascal_50, scores.precision_20px,
        scores.mean_center_error_px, scores.part_error_mean_px, scores.pck_10}) {
    EXPECT_TRUE(std::isnan(figure));
  }
  EXPECT_DOUBLE_EQ(scores.fps, 500.0);
}

TEST(Metrics, ALostFrameCountsAsNoOverlapWhereThereIsAnObject) {
  const Scores scores = summarize({seen(0.8, 2.0), lostFrame()}, 100.0, {});
  EXPECT_DOUBLE_EQ(scores.mean_iou, 0.4);
  EXPECT_DOUBLE_EQ(scores.precision_20px, 0.5);
  EXPECT_DOUBLE_EQ(scores.mean_center_error_px, 2.0) << "over the frames not lost";
  EXPECT_EQ(scores.lost_frames, 1);
}

TEST(Metrics, BeingLostIsNoFaultWhereThereIsNoObject) {
  FrameScore absent;
  absent.lost = true;
  const Scores scores = summarize({seen(1.0, 0.0), absent, seen(1.0, 0.0)}, 100.0, {});
  EXPECT_EQ(scores.lost_frames, 0);
  EXPECT_EQ(scores.reacquired, 1);
  EXPECT_DOUBLE_EQ(scores.mean_iou, 1.0);
}

TEST(Metrics, FoundAgainNeedsOverlap) {
  EXPECT_EQ(summarize({lostFrame(), lostFrame(), seen(0.3, 9.0)}, 100.0, {}).reacquired, 1);
  EXPECT_EQ(summarize({lostFrame(), seen(0.0, 99.0)}, 100.0, {}).reacquired, 0);
}

TEST(Metrics, PckCountsPointsWithinATenthOfTheLength) {
  FrameScore found;
  found.point_errors = {1.0, 10.0, 10.5};
  FrameScore lost;
  lost.lost = true;
  lost.point_errors = {kInfinity};
  const Scores scores = summarize({found, lost}, 100.0, {});
  // The frames have points but no box: only the points count.
  EXPECT_EQ(scores.scored_frames, 0);
  EXPECT_DOUBLE_EQ(scores.pck_10, 0.5);
  EXPECT_DOUBLE_EQ(scores.part_error_median_px, 10.0);
  EXPECT_NEAR(scores.part_error_mean_px, 21.5 / 3.0, 1e-12);
}

TEST(Metrics, RateIsThatOfTheMeanTime) {
  const Scores scores = summarize({seen(1.0, 0.0)}, 100.0, {1.0, 3.0});
  EXPECT_DOUBLE_EQ(scores.fps, 500.0);
  EXPECT_DOUBLE_EQ(scores.latency_p50_ms, 2.0);
}

}  // namespace
}  // namespace chain_tracker
