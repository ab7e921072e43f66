// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/similarity_fit.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "support/random_inputs.h"

namespace chain_tracker {
namespace {

struct Correspondences {
  std::vector<cv::Point2d> from;
  std::vector<cv::Point2d> to;
  std::vector<double> weights;

  /// What the fit minimises, written out.
  double costOf(const Similarity& transform) const {
    double cost = 0.0;
    for (size_t k = 0; k < from.size(); ++k) {
      const cv::Point2d error = to[k] - transform.apply(from[k]);
      cost += weights[k] * error.dot(error);
    }
    return cost;
  }
  Similarity fit() const { return fitSimilarity(from, to, weights); }
  std::vector<double> robustWeights(double tolerance) const {
    std::vector<double> robust;
    chain_tracker::robustWeights(from, to, weights, tolerance, robust);
    return robust;
  }
};

/// Points moved by the transform and then by up to `noise` [px].
Correspondences movedPoints(RandomInputs& random, const Similarity& transform, double noise) {
  Correspondences points;
  points.from = random.points(12, -80.0, 80.0);
  for (const cv::Point2d& point : points.from) {
    points.to.push_back(transform.apply(point) + random.point(-noise, noise));
    points.weights.push_back(random.real(0.05, 2.0));
  }
  return points;
}

Similarity someTransform(RandomInputs& random) {
  return {random.real(-CV_PI, CV_PI), random.real(0.2, 4.0), random.point(-300.0, 300.0)};
}

void expectEqual(const Similarity& expected, const Similarity& actual, double tolerance) {
  EXPECT_NEAR(0.0, wrapAngle(expected.angle - actual.angle), tolerance);
  EXPECT_NEAR(expected.scale, actual.scale, tolerance);
  EXPECT_NEAR(expected.translation.x, actual.translation.x, tolerance);
  EXPECT_NEAR(expected.translation.y, actual.translation.y, tolerance);
}

TEST(FitSimilarity, findsTheTransformThatMovedThePoints) {
  RandomInputs random(1);
  for (int repeat = 0; repeat < 100; ++repeat) {
    SCOPED_TRACE("repeat " + std::to_string(repeat));
    const Similarity truth = someTransform(random);
    expectEqual(truth, movedPoints(random, truth, 0.0).fit(), 1e-9);
  }
}

TEST(FitSimilarity, twoPointsAreEnough) {
  const Similarity fit = fitSimilarity({{0, 0}, {10, 0}}, {{5, 5}, {5, 25}}, {1.0, 3.0});
  expectEqual({CV_PI / 2.0, 2.0, {5.0, 5.0}}, fit, 1e-12);
}

/// A quadratic cost in four unknowns has one minimum: no change of any one may pay, and near it
/// every direction must go up by the same amount on both sides.
TEST(FitSimilarity, noChangeOfTheFitCostsLess) {
  RandomInputs random(2);
  for (int repeat = 0; repeat < 50; ++repeat) {
    SCOPED_TRACE("repeat " + std::to_string(repeat));
    const Correspondences points = movedPoints(random, someTransform(random), 25.0);
    const Similarity fit = points.fit();
    const double least = points.costOf(fit);
    for (double step : {1e-3, 0.1}) {
      for (int i = 0; i < 8; ++i) {
        const double signed_step = i % 2 == 0 ? step : -step;
        Similarity changed = fit;
        if (i / 2 == 0) changed.angle += signed_step;
        if (i / 2 == 1) changed.scale += signed_step;
        if (i / 2 == 2) changed.translation.x += signed_step;
        if (i / 2 == 3) changed.translation.y += signed_step;
        EXPECT_GT(points.costOf(changed), least) << "change " << i << " of " << step;
      }
    }
  }
}

TEST(FitSimilarity, noOtherTransformCostsLess) {
  RandomInputs random(3);
  const Correspondences points = movedPoints(random, someTransform(random), 40.0);
  const double least = points.costOf(points.fit());
  for (double angle = -3.1; angle < 3.15; angle += 0.05) {
    for (double scale = 0.05; scale < 5.0; scale *= 1.05) {
      const cv::Point2d translation =
          fitTranslation(points.from, points.to, points.weights, angle, scale);
      EXPECT_GE(points.costOf({angle, scale, translation}), least);
    }
  }
}

TEST(FitSimilarity, weightCountsAPointThatManyTimes) {
  RandomInputs random(4);
  Correspondences weighted = movedPoints(random, someTransform(random), 10.0);
  Correspondences repeated;
  for (size_t k = 0; k < weighted.from.size(); ++k) {
    const size_t times = k % 4;
    weighted.weights[k] = double(times);
    repeated.from.insert(repeated.from.end(), times, weighted.from[k]);
    repeated.to.insert(repeated.to.end(), times, weighted.to[k]);
    repeated.weights.insert(repeated.weights.end(), times, 1.0);
  }
  expectEqual(repeated.fit(), weighted.fit(), 1e-9);
}

TEST(FitSimilarity, pointsWithoutWeightDoNotCount) {
  RandomInputs random(5);
  const Similarity truth = someTransform(random);
  Correspondences points = movedPoints(random, truth, 0.0);
  points.to[3] = {1e6, -1e6};
  points.weights[3] = 0.0;
  expectEqual(truth, points.fit(), 1e-9);
}

TEST(FitSimilarity, onlyRatiosOfWeightsCount) {
  RandomInputs random(6);
  Correspondences points = movedPoints(random, someTransform(random), 10.0);
  const Similarity fit = points.fit();
  for (double& weight : points.weights) weight *= 1e-3;
  expectEqual(fit, points.fit(), 1e-9);
}

TEST(FitSimilarity, mirroredPointsAreNotMirrored) {
  const std::vector<cv::Point2d> from = {{-20, -10}, {20, -10}, {20, 10}, {-20, 10}};
  std::vector<cv::Point2d> to = from;
  for (cv::Point2d& point : to) point.y = -point.y;
  const Correspondences points{from, to, {1, 1, 1, 1}};
  // The best turn is none; the scale is (20^2 - 10^2) / (20^2 + 10^2).
  expectEqual({0.0, 0.6, {0.0, 0.0}}, points.fit(), 1e-9);
}

TEST(FitSimilarity, coincidingPointsOnlyMove) {
  RandomInputs random(7);
  for (int repeat = 0; repeat < 200; ++repeat) {
    SCOPED_TRACE("repeat " + std::to_string(repeat));
    Correspondences points;
    points.from.assign(5, random.point(-500.0, 500.0));
    points.to = random.points(5, -500.0, 500.0);
    for (size_t k = 0; k < 5; ++k) points.weights.push_back(random.real(0.1, 1.0));
    const Similarity fit = points.fit();
    ASSERT_EQ(0.0, fit.angle);
    ASSERT_EQ(1.0, fit.scale);
    const cv::Point2d expected = fitTranslation(points.from, points.to, points.weights, 0.0, 1.0);
    EXPECT_EQ(expected, fit.translation);
  }
}

TEST(FitSimilarity, pointsThatCoincideButForTheWeightlessOnesOnlyMove) {
  const Similarity fit =
      fitSimilarity({{3, 4}, {3, 4}, {90, 90}}, {{13, 4}, {13, 6}, {0, 0}}, {1.0, 1.0, 0.0});
  expectEqual({0.0, 1.0, {10.0, 1.0}}, fit, 1e-12);
}

TEST(FitSimilarity, onePointOnlyMoves) {
  expectEqual({0.0, 1.0, {7.0, -3.0}}, fitSimilarity({{1, 2}}, {{8, -1}}, {0.5}), 1e-12);
}

TEST(RobustWeights, areTheGivenOnesWhereEverythingFits) {
  RandomInputs random(10);
  const Correspondences points = movedPoints(random, someTransform(random), 0.0);
  const std::vector<double> robust = points.robustWeights(5.0);
  for (size_t k = 0; k < robust.size(); ++k) EXPECT_NEAR(points.weights[k], robust[k], 1e-9);
}

/// A quarter of the points have slid off together, as parts onto a look-alike do.
TEST(RobustWeights, letTheFitHeedTheBulkOfThePoints) {
  RandomInputs random(11);
  for (int repeat = 0; repeat < 50; ++repeat) {
    SCOPED_TRACE("repeat " + std::to_string(repeat));
    const Similarity truth{random.real(-CV_PI, CV_PI), random.real(0.8, 1.25), {}};
    Correspondences points = movedPoints(random, truth, 0.5);
    points.weights.assign(points.from.size(), 1.0);
    for (size_t k = 0; k < 3; ++k) points.to[k] += cv::Point2d(30.0, 0.0);
    const double before = cv::norm(points.fit().translation);
    points.weights = points.robustWeights(8.0);
    EXPECT_LT(cv::norm(points.fit().translation), 0.5 * before);
    for (size_t k = 0; k < 3; ++k) EXPECT_LT(points.weights[k], 0.25);
  }
}

TEST(RobustWeights, followFromTheErrorsOfTheirOwnFit) {
  RandomInputs random(12);
  Correspondences points = movedPoints(random, someTransform(random), 3.0);
  const std::vector<double> given = points.weights;
  points.weights = points.robustWeights(6.0);
  const Similarity fit = points.fit();
  for (size_t k = 0; k < given.size(); ++k) {
    const double error = cv::norm(points.to[k] - fit.apply(points.from[k])) / 6.0;
    EXPECT_NEAR(given[k] / std::pow(1.0 + error * error, 2.0), points.weights[k], 0.02 * given[k]);
  }
}

TEST(FitTranslation, belongsToTheFit) {
  RandomInputs random(8);
  const Correspondences points = movedPoints(random, someTransform(random), 15.0);
  const Similarity fit = points.fit();
  const cv::Point2d translation =
      fitTranslation(points.from, points.to, points.weights, fit.angle, fit.scale);
  EXPECT_LT(cv::norm(translation - fit.translation), 1e-9);
}

TEST(FitTranslation, noOtherTranslationCostsLess) {
  RandomInputs random(9);
  const Correspondences points = movedPoints(random, someTransform(random), 15.0);
  const Similarity turned{0.4, 1.3,
                          fitTranslation(points.from, points.to, points.weights, 0.4, 1.3)};
  for (const cv::Point2d& step :
       {cv::Point2d(0.01, 0), cv::Point2d(-0.01, 0), cv::Point2d(0, 0.01), cv::Point2d(0, -0.01)}) {
    Similarity moved = turned;
    moved.translation += step;
    EXPECT_GT(points.costOf(moved), points.costOf(turned));
  }
}

}  // namespace
}  // namespace chain_tracker
