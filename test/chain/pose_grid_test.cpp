// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/pose_grid.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(TemporalCost, isHalfASquareADeviation) {
  SegmentModel model;
  model.orientation_sigma = 0.2;
  model.scale_sigma = 0.05;
  const SegmentPose previous{3.1, 2.0};
  EXPECT_EQ(0.0, temporalCost(model, previous, previous));
  EXPECT_NEAR(0.5, temporalCost(model, previous, {2.9, 2.0}), 1e-12);
  EXPECT_NEAR(0.5, temporalCost(model, previous, {3.3 - 2.0 * CV_PI, 2.0}), 1e-12);
  EXPECT_NEAR(2.0, temporalCost(model, previous, {3.1, 2.0 * std::exp(0.1)}), 1e-12);
  EXPECT_NEAR(2.0, temporalCost(model, previous, {3.1, 2.0 * std::exp(-0.1)}), 1e-12);
  EXPECT_NEAR(2.5, temporalCost(model, previous, {2.9, 2.0 * std::exp(-0.1)}), 1e-12);
}

TEST(PoseGrid, stepsAroundItsMiddle) {
  const PoseGrid poses{{3.0, 2.0}, 5, 0.1, 3, 0.25};
  EXPECT_NEAR(3.0, poses.at(2, 1).orientation, 1e-12);
  EXPECT_NEAR(2.0, poses.at(2, 1).scale, 1e-12);
  EXPECT_NEAR(2.8, poses.at(0, 1).orientation, 1e-12);
  EXPECT_NEAR(3.2 - 2.0 * CV_PI, poses.at(4, 1).orientation, 1e-12);
  EXPECT_NEAR(2.0 * std::exp(-0.25), poses.at(2, 0).scale, 1e-12);
  EXPECT_NEAR(2.0 * std::exp(0.125), poses.at(2, 1.5).scale, 1e-12);
  EXPECT_NEAR(3.05, poses.at(2.5, 1).orientation, 1e-12);
}

TEST(PoseGrid, hasEachPoseOfItsMiddleRowAndColumnOnce) {
  const PoseGrid poses{{0.5, 1.0}, 5, 0.1, 3, 0.2};
  EXPECT_EQ(7U, poses.size());
  cv::Mat1i times(5, 3, 0);
  for (size_t i = 0; i < poses.size(); ++i) {
    const cv::Point cell = poses.cellOf(i);
    ++times(cell);
    EXPECT_EQ(poses.at(cell.y, cell.x).orientation, poses.at(i).orientation);
    EXPECT_EQ(poses.at(cell.y, cell.x).scale, poses.at(i).scale);
  }
  const cv::Mat1i expected = (cv::Mat1i(5, 3) << 0, 1, 0, 0, 1, 0, 1, 1, 1, 0, 1, 0, 0, 1, 0);
  EXPECT_EQ(0, cv::countNonZero(times != expected)) << times;
}

TEST(JointCost, isNothingWithinTheLimits) {
  const JointModel elbow{-0.5, 2.0};
  EXPECT_FALSE(isFree(elbow));
  for (double angle : {-0.5, 0.0, 1.0, 2.0}) {
    EXPECT_EQ(0.0, jointCost(elbow, {1.0, 1.0}, {1.0 + angle, 2.0})) << angle;
  }
  EXPECT_EQ(0.0, jointCost(elbow, {3.0, 1.0}, {4.0 - 2.0 * CV_PI, 1.0}));
}

/// A standard deviation is 0.05 rad; the nearer limit counts, also across the half turn.
TEST(JointCost, risesBeyondTheNearerLimit) {
  const JointModel elbow{-0.5, 2.0};
  EXPECT_NEAR(0.5, jointCost(elbow, {1.0, 1.0}, {3.05, 1.0}), 1e-9);
  EXPECT_NEAR(2.0, jointCost(elbow, {1.0, 1.0}, {0.4, 1.0}), 1e-9);
  EXPECT_NEAR(2.0 * 0.5, jointCost(elbow, {0.0, 1.0}, {2.0 + 0.05 * std::sqrt(2.0), 1.0}), 1e-9);
  const double across = -CV_PI + 0.1;  // 1.24 rad beyond the upper limit, 2.54 below the lower one
  const double excess = CV_PI + 0.1 - 2.0;
  EXPECT_NEAR(0.5 * excess * excess / (0.05 * 0.05), jointCost(elbow, {0.0, 1.0}, {across, 1.0}),
              1e-6);
}

TEST(JointCost, ofAFreeJointIsNothing) {
  EXPECT_TRUE(isFree(JointModel()));
  for (double angle = -3.2; angle < 3.2; angle += 0.1) {
    EXPECT_EQ(0.0, jointCost(JointModel(), {0.3, 1.0}, {0.3 + angle, 1.0})) << angle;
  }
}

TEST(RestCost, risesAroundTheAngleOfRestAndNoFurtherThanTwenty) {
  const JointRest rest{3.0, 0.2};
  EXPECT_NEAR(0.0, restCost(rest, {0.5, 1.0}, {3.5, 2.0}), 1e-12);
  EXPECT_NEAR(0.5, restCost(rest, {0.5, 1.0}, {3.3, 1.0}), 1e-9);
  EXPECT_NEAR(2.0, restCost(rest, {0.0, 1.0}, {3.4 - 2.0 * CV_PI, 1.0}), 1e-9);
  EXPECT_EQ(20.0, restCost(rest, {0.0, 1.0}, {0.0, 1.0}));
}

TEST(RestCost, isNothingWhereAJointRestsAnywhere) {
  EXPECT_EQ(0.0, restCost({1.0, 0.0}, {0.0, 1.0}, {-2.0, 1.0}));
}

cv::Mat1d bowl(double row_minimum, double column_minimum) {
  cv::Mat1d energies(5, 3);
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 3; ++column) {
      energies(row, column) = 7.0 + 2.0 * (row - row_minimum) * (row - row_minimum) +
                              3.0 * (column - column_minimum) * (column - column_minimum);
    }
  }
  return energies;
}

const PoseGrid kPoses{{0.5, 1.0}, 5, 0.1, 3, 0.2};

void expectPose(double row, double column, const SegmentPose& pose) {
  EXPECT_NEAR(kPoses.at(row, column).orientation, pose.orientation, 1e-9);
  EXPECT_NEAR(kPoses.at(row, column).scale, pose.scale, 1e-9);
}

TEST(InterpolatePose, findsTheBottomOfABowl) {
  for (double row : {1.6, 2.0, 2.3}) {
    for (double column : {0.7, 1.0, 1.45}) {
      expectPose(row, column, interpolatePose(kPoses, bowl(row, column)));
    }
  }
}

TEST(InterpolatePose, staysAtTheBorderOfTheGrid) {
  expectPose(0, 1.2, interpolatePose(kPoses, bowl(-0.3, 1.2)));
  expectPose(4, 1.2, interpolatePose(kPoses, bowl(4.2, 1.2)));
  expectPose(2.2, 0, interpolatePose(kPoses, bowl(2.2, -0.4)));
  expectPose(2.2, 2, interpolatePose(kPoses, bowl(2.2, 2.4)));
}

TEST(InterpolatePose, staysNextToForbiddenPoses) {
  cv::Mat1d energies = bowl(2.2, 1.2);
  energies(3, 1) = kInfinity;
  energies(2, 0) = kInfinity;
  expectPose(2, 1, interpolatePose(kPoses, energies));
}

TEST(InterpolatePose, staysOnLevelGround) {
  expectPose(0, 0, interpolatePose(kPoses, cv::Mat1d(5, 3, 4.0)));
}

TEST(InterpolatePose, ofASinglePoseIsThatPose) {
  const PoseGrid one{{0.5, 1.5}, 1, 0.1, 1, 0.2};
  const SegmentPose pose = interpolatePose(one, cv::Mat1d(1, 1, 3.0));
  EXPECT_NEAR(0.5, pose.orientation, 1e-12);
  EXPECT_NEAR(1.5, pose.scale, 1e-12);
}

}  // namespace
}  // namespace chain_tracker
