// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/pixel_geometry.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/random_inputs.h"

namespace chain_tracker {
namespace {

void expectNear(const cv::Point2d& expected, const cv::Point2d& actual, double tolerance) {
  EXPECT_NEAR(expected.x, actual.x, tolerance);
  EXPECT_NEAR(expected.y, actual.y, tolerance);
}

TEST(WrapAngle, keepsAnglesWithinHalfATurn) {
  for (double angle : {0.0, 1.0, -1.0, 3.1, -3.1, CV_PI}) EXPECT_EQ(angle, wrapAngle(angle));
}

TEST(WrapAngle, halfATurnIsPositive) {
  EXPECT_EQ(CV_PI, wrapAngle(CV_PI));
  EXPECT_EQ(CV_PI, wrapAngle(-CV_PI));
  EXPECT_NEAR(CV_PI, std::abs(wrapAngle(3.0 * CV_PI)), 1e-12);
}

TEST(WrapAngle, removesWholeTurns) {
  for (int turns = -20; turns <= 20; ++turns) {
    for (double angle = -3.1; angle < 3.15; angle += 0.2) {
      EXPECT_NEAR(angle, wrapAngle(angle + turns * 2.0 * CV_PI), 1e-12) << turns << " turns";
    }
  }
}

TEST(WrapAngle, isNeverOutsideItsRange) {
  RandomInputs random(1);
  for (int i = 0; i < 1000; ++i) {
    const double angle = random.real(-100.0, 100.0);
    EXPECT_GT(wrapAngle(angle), -CV_PI) << angle;
    EXPECT_LE(wrapAngle(angle), CV_PI) << angle;
  }
}

TEST(DirectionOf, isMeasuredFromRightTowardsDown) {
  EXPECT_EQ(0.0, directionOf({3.0, 0.0}));
  EXPECT_DOUBLE_EQ(CV_PI / 2.0, directionOf({0.0, 2.0}));
  EXPECT_DOUBLE_EQ(-CV_PI / 2.0, directionOf({0.0, -2.0}));
  EXPECT_DOUBLE_EQ(CV_PI / 4.0, directionOf({5.0, 5.0}));
  EXPECT_EQ(CV_PI, directionOf({-1.0, 0.0}));
}

TEST(DirectionOf, signOfZeroDoesNotMatter) {
  EXPECT_EQ(CV_PI, directionOf({-1.0, -0.0}));
  EXPECT_EQ(0.0, directionOf({0.0, 0.0}));
  EXPECT_EQ(0.0, directionOf({-0.0, 0.0}));
  EXPECT_EQ(0.0, directionOf({0.0, -0.0}));
  EXPECT_EQ(0.0, directionOf({-0.0, -0.0}));
}

TEST(Similarity, scalesThenTurnsThenShifts) {
  const Similarity transform{CV_PI / 2.0, 2.0, {10.0, 20.0}};
  expectNear({10.0, 22.0}, transform.apply({1.0, 0.0}), 1e-12);
  expectNear({8.0, 20.0}, transform.apply({0.0, 1.0}), 1e-12);
  expectNear({10.0, 20.0}, transform.apply({0.0, 0.0}), 1e-12);
}

TEST(Similarity, isTheIdentityUnlessTold) {
  expectNear({3.5, -7.0}, Similarity().apply({3.5, -7.0}), 0.0);
}

TEST(Similarity, inverseLeadsBack) {
  RandomInputs random(2);
  for (int i = 0; i < 100; ++i) {
    const Similarity transform{random.real(-4.0, 4.0), random.real(0.1, 10.0),
                               random.point(-500.0, 500.0)};
    const cv::Point2d point = random.point(-500.0, 500.0);
    expectNear(point, transform.applyInverse(transform.apply(point)), 1e-9);
    expectNear(point, transform.apply(transform.applyInverse(point)), 1e-9);
  }
}

TEST(UprightBounds, holdAllPoints) {
  const cv::Rect2d bounds = uprightBounds({{3.0, -1.0}, {-2.0, 4.0}, {0.0, 0.5}});
  EXPECT_EQ(cv::Rect2d(-2.0, -1.0, 5.0, 5.0), bounds);
}

TEST(UprightBounds, ofOnePointAreThatPoint) {
  EXPECT_EQ(cv::Rect2d(7.0, 8.0, 0.0, 0.0), uprightBounds({{7.0, 8.0}}));
}

TEST(UprightBounds, ofPointsOnALineHaveNoHeight) {
  EXPECT_EQ(cv::Rect2d(1.0, 2.0, 4.0, 0.0), uprightBounds({{5.0, 2.0}, {1.0, 2.0}}));
}

TEST(UprightBounds, needAPoint) { EXPECT_THROW(uprightBounds({}), cv::Exception); }

TEST(LengthOf, addsTheEdges) {
  EXPECT_EQ(0.0, lengthOf({}));
  EXPECT_EQ(0.0, lengthOf({{7.0, 8.0}}));
  EXPECT_NEAR(5.0 + 2.0, lengthOf({{0.0, 0.0}, {3.0, 4.0}, {3.0, 2.0}}), 1e-9);
}

}  // namespace
}  // namespace chain_tracker
