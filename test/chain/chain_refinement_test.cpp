// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/chain_refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "support/lattice_candidates.h"

namespace chain_tracker {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

SegmentLayout onePart() {
  SegmentLayout segment;
  segment.parts.push_back({{0.0, 0.0}, 10.0});
  return segment;
}

std::vector<RefinedPart> refineSegment(const SegmentLayout& segment, const CandidateGrid& grid,
                                       const std::vector<cv::Mat1f>& costs) {
  ChainRefinementWorkspace workspace;
  return refineChain({segment}, {{0.0, 1.0}}, {candidatesOn(grid, costs)}, workspace);
}

/// Costs of a Gaussian: 1/2 (p - mean)' covariance^-1 (p - mean).
cv::Mat1f gaussianCosts(const CandidateGrid& grid, size_t part, const cv::Point2d& mean,
                        const cv::Matx22d& covariance) {
  const cv::Matx22d inverse = covariance.inv();
  cv::Mat1f costs(grid.states);
  for (int row = 0; row < costs.rows; ++row) {
    for (int column = 0; column < costs.cols; ++column) {
      const cv::Point2d p = grid.positionOf(part, cv::Point2d(column, row)) - mean;
      const cv::Vec2d q(p.x, p.y);
      costs(row, column) = static_cast<float>(0.5 * q.dot(inverse * q));
    }
  }
  return costs;
}

void expectCovariance(const cv::Matx22d& expected, const cv::Matx22d& actual, double relative) {
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(expected.val[i], actual.val[i], relative * cv::norm(expected)) << "element " << i;
  }
}

TEST(RefineChain, findsPositionAndCovarianceOfAGaussian) {
  for (int step : {1, 2, 5}) {
    for (const cv::Point2d& offset : {cv::Point2d(0, 0), cv::Point2d(0.4, -0.3)}) {
      const CandidateGrid grid = gridAround({{60, 40}}, 11.0, step, 4.0 * step);
      const cv::Point2d mean = grid.positionOf(0, {5.0, 3.0}) + step * offset;
      const cv::Matx22d covariance(9.0, 0.0, 0.0, 4.0);
      const std::vector<cv::Mat1f> costs = {gaussianCosts(grid, 0, mean, covariance)};
      const auto parts = refineSegment(onePart(), grid, costs);
      ASSERT_EQ(1U, parts.size());
      EXPECT_LT(cv::norm(parts[0].position - mean), 1e-3 * step);
      EXPECT_EQ(costs[0](3, 5), parts[0].appearance);
      expectCovariance(covariance, parts[0].covariance, 1e-3);
    }
  }
}

TEST(RefineChain, findsPositionAndCovarianceOfATurnedGaussian) {
  const CandidateGrid grid = gridAround({{60, 40}}, 11.0, 1, 4.0);
  const cv::Point2d mean = grid.positionOf(0, {5.0, 3.0}) + cv::Point2d(0.4, 0.4);
  const cv::Matx22d covariance(9.0, 7.0, 7.0, 9.0);
  const std::vector<cv::Mat1f> costs = {gaussianCosts(grid, 0, mean, covariance)};
  const auto parts = refineSegment(onePart(), grid, costs);
  ASSERT_EQ(1U, parts.size());
  EXPECT_LT(cv::norm(parts[0].position - mean), 1e-3);
  expectCovariance(covariance, parts[0].covariance, 1e-3);
}

/// A ridge along one diagonal only: its second differences are those of no quadratic.
TEST(RefineChain, covarianceOfALopsidedBowlKeepsTheWidthsOfItsAxes) {
  const CandidateGrid grid = gridAround({{60, 40}}, 11.0, 1, 4.0);
  const cv::Point middle(grid.states / 2);
  const cv::Point2d mean = grid.positionOf(0, cv::Point2d(middle));
  cv::Mat1f costs = gaussianCosts(grid, 0, mean, cv::Matx22d(9.0, 0.0, 0.0, 4.0));
  for (int row = 0; row < costs.rows; ++row) {
    for (int column = 0; column < costs.cols; ++column) {
      const int product = (column - middle.x) * (row - middle.y);
      costs(row, column) += 2.0F * static_cast<float>(std::max(0, product));
    }
  }
  const auto parts = refineSegment(onePart(), grid, {costs});
  ASSERT_EQ(1U, parts.size());
  EXPECT_EQ(mean, parts[0].position);
  expectCovariance(cv::Matx22d(9.0, 0.0, 0.0, 4.0), parts[0].covariance, 1e-3);
}

TEST(RefineChain, covarianceIsUnknownAtTheBorderOfTheSearch) {
  const CandidateGrid grid = gridAround({{60, 40}}, 11.0, 1, 4.0);
  const cv::Point2d mean = grid.positionOf(0, {0.0, 3.0});
  const std::vector<cv::Mat1f> costs = {gaussianCosts(grid, 0, mean, cv::Matx22d::eye())};
  const auto parts = refineSegment(onePart(), grid, costs);
  ASSERT_EQ(1U, parts.size());
  EXPECT_EQ(mean, parts[0].position);
  for (double value : parts[0].covariance.val) EXPECT_TRUE(std::isnan(value));
}

TEST(RefineChain, covarianceIsUnknownOnLevelGround) {
  const CandidateGrid grid = gridAround({{60, 40}}, 11.0, 1, 4.0);
  const auto parts = refineSegment(onePart(), grid, {cv::Mat1f(grid.states, 2.0F)});
  ASSERT_EQ(1U, parts.size());
  for (double value : parts[0].covariance.val) EXPECT_TRUE(std::isnan(value));
}

TEST(RefineChain, isEmptyWhereNoChainIsAllowed) {
  const CandidateGrid grid = gridAround({{60, 40}}, 11.0, 1, 4.0);
  const cv::Mat1f forbidden(grid.states, static_cast<float>(kInfinity));
  EXPECT_TRUE(refineSegment(onePart(), grid, {forbidden}).empty());
}

/// A part that is not seen itself is known as well as its neighbour and their spring are: variances
/// add up, along the spring 9 + 3^2, across it 9 + (30 x 0.1)^2, and the lattice's 1/6 to both.
TEST(RefineChain, hiddenPartIsAsUncertainAsItsNeighbourAndTheSpring) {
  SegmentLayout segment = onePart();
  segment.parts.push_back({{30.0, 0.0}, 10.0});
  segment.edges.push_back({30.0, 0.0, 0.1, 0.1});
  const CandidateGrid grid = gridAround({{60, 60}, {90, 60}}, 11.0, 1, 12.0);
  const cv::Point middle(grid.states / 2);
  const cv::Point2d mean = grid.positionOf(0, cv::Point2d(middle));
  const std::vector<cv::Mat1f> costs = {gaussianCosts(grid, 0, mean, cv::Matx22d::eye() * 9.0),
                                        cv::Mat1f(grid.states, 5.0F)};
  const auto parts = refineSegment(segment, grid, costs);
  ASSERT_EQ(2U, parts.size());
  EXPECT_LT(cv::norm(parts[0].position - mean), 1e-6);
  EXPECT_LT(cv::norm(parts[1].position - mean - cv::Point2d(30, 0)), 1e-6);
  expectCovariance(cv::Matx22d::eye() * 9.0, parts[0].covariance, 1e-3);
  expectCovariance(cv::Matx22d::eye() * (18.0 + 1.0 / 6.0), parts[1].covariance, 0.1);
}

}  // namespace
}  // namespace chain_tracker
