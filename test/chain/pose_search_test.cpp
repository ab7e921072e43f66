// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/pose_search.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "chain_tracker/image/pixel_geometry.h"
#include "support/brute_force.h"
#include "support/map_difference.h"
#include "support/random_inputs.h"

namespace chain_tracker {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A chain of the given edges, starting at the frame's origin.
SegmentLayout chainOf(const std::vector<EdgeLayout>& edges) {
  SegmentLayout segment;
  segment.edges = edges;
  segment.parts.push_back({{0.0, 0.0}, 10.0});
  for (const EdgeLayout& edge : edges) {
    const cv::Point2d vector(std::cos(edge.direction), std::sin(edge.direction));
    segment.parts.push_back({segment.parts.back().position + edge.length * vector, 10.0});
  }
  return segment;
}

std::vector<cv::Point2d> placed(const SegmentLayout& segment, const Similarity& transform) {
  std::vector<cv::Point2d> positions;
  for (const PartLayout& part : segment.parts) positions.push_back(transform.apply(part.position));
  return positions;
}

/// The springs of the model in the image, as its documentation tells them: turned and scaled with
/// the pose, both variances widened by rounding to the lattice.
brute_force::EdgeCost springsOf(const SegmentLayout& segment, const SegmentPose& pose,
                                const CandidateGrid& grid) {
  return [=](size_t k, const cv::Point& from, const cv::Point& to) {
    const EdgeLayout& edge = segment.edges[k];
    const double length = pose.scale * edge.length;
    const double rounding = double(grid.lattice.step) * grid.lattice.step / 6.0;
    const double stretch = edge.stretch_sigma * length;
    const EdgePotential spring{
        length, pose.orientation + edge.direction, std::sqrt(stretch * stretch + rounding),
        std::sqrt(edge.bend_sigma * edge.bend_sigma + rounding / (length * length))};
    return brute_force::springCost(
        spring, grid.positionOf(k + 1, cv::Point2d(to)) - grid.positionOf(k, cv::Point2d(from)));
  };
}

double temporalCostByHand(const SegmentModel& model, const SegmentPose& previous,
                          const SegmentPose& pose) {
  double turn = pose.orientation - previous.orientation;
  while (turn > CV_PI) turn -= 2.0 * CV_PI;
  while (turn < -CV_PI) turn += 2.0 * CV_PI;
  const double turn_sigmas = turn / model.orientation_sigma;
  const double growth_sigmas =
      (std::log(pose.scale) - std::log(previous.scale)) / model.scale_sigma;
  return 0.5 * (turn_sigmas * turn_sigmas + growth_sigmas * growth_sigmas);
}

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
  EXPECT_EQ(15U, poses.size());
  EXPECT_NEAR(3.0, poses.at(2, 1).orientation, 1e-12);
  EXPECT_NEAR(2.0, poses.at(2, 1).scale, 1e-12);
  EXPECT_NEAR(2.8, poses.at(0, 1).orientation, 1e-12);
  EXPECT_NEAR(3.2 - 2.0 * CV_PI, poses.at(4, 1).orientation, 1e-12);
  EXPECT_NEAR(2.0 * std::exp(-0.25), poses.at(2, 0).scale, 1e-12);
  EXPECT_NEAR(2.0 * std::exp(0.125), poses.at(2, 1.5).scale, 1e-12);
  EXPECT_NEAR(3.05, poses.at(2.5, 1).orientation, 1e-12);
}

/// All pairs of states of neighbouring parts; some edges are alike, some only nearly so.
TEST(SampleEdges, costWhatTheSpringsCostBetweenTheCandidates) {
  RandomInputs random(1);
  const SegmentLayout segment = chainOf({{14.0, 0.3, 0.1, 0.2},
                                         {11.0, CV_PI, 0.1, 0.2},
                                         {14.0, 0.3, 0.1, 0.2},
                                         {11.0, -CV_PI, 0.1, 0.2},
                                         {14.0, 0.3, 0.2, 0.2},
                                         {14.0, 0.3, 0.1, 0.3},
                                         {14.0, 0.5, 0.1, 0.2},
                                         {14.5, 0.3, 0.1, 0.2}});
  for (int step : {1, 3}) {
    const SegmentPose pose{0.7, 1.1};
    const Similarity transform{0.6, 1.15, {50, 50}};
    std::vector<cv::Point2d> centers = placed(segment, transform);
    for (cv::Point2d& center : centers) center += random.point(-3.0, 3.0);
    const CandidateGrid grid = makeCandidateGrid(centers, 10.0, step, 2.0 * step);
    const std::vector<EdgeStencil> edges = sampleEdges(segment, grid, pose);
    ASSERT_EQ(segment.edges.size(), edges.size());
    const auto spring = springsOf(segment, pose, grid);
    for (size_t k = 0; k < edges.size(); ++k) {
      SCOPED_TRACE("edge " + std::to_string(k) + ", step " + std::to_string(step));
      // The first part's state is at one border or the other, so that all offsets occur.
      int allowed = 0;
      for (int rows = 1 - grid.states.height; rows < grid.states.height; ++rows) {
        for (int columns = 1 - grid.states.width; columns < grid.states.width; ++columns) {
          const cv::Point from(std::max(0, -columns), std::max(0, -rows));
          const cv::Point offset(columns, rows);
          const double expected = spring(k, from, from + offset);
          const double sampled = brute_force::stencilCost(edges[k], offset);
          if (expected == sampled) continue;  // both are forbidden
          ASSERT_NEAR(expected, sampled, 1e-5) << offset;
          ++allowed;
        }
      }
      EXPECT_GT(allowed, 0);
    }
  }
}

struct Match {
  SegmentLayout segment;
  SegmentModel model;
  SegmentPose previous;
  PoseGrid poses;
  CandidateGrid grid;
  std::vector<cv::Mat1f> costs;
};

/// Few states and poses, somewhere, with random costs.
Match tinyMatch(RandomInputs& random, int reach, size_t edge_count) {
  Match match;
  std::vector<EdgeLayout> edges;
  for (size_t k = 0; k < edge_count; ++k) {
    edges.push_back({random.real(6.0, 15.0), random.real(-CV_PI, CV_PI), random.real(0.03, 0.2),
                     random.real(0.05, 0.3)});
  }
  match.segment = chainOf(edges);
  match.previous = {random.real(-CV_PI, CV_PI), random.real(0.7, 1.5)};
  match.model.orientation_sigma = random.real(0.1, 0.5);
  match.model.scale_sigma = random.real(0.05, 0.3);
  match.poses = {match.previous, 5, 0.15, 3, 0.1};
  const Similarity transform{match.previous.orientation + random.real(-0.3, 0.3),
                             match.previous.scale * random.real(0.9, 1.1),
                             {50, 50}};
  const int step = random.integer(1, 3);
  match.grid = makeCandidateGrid(placed(match.segment, transform), 10.0, step, reach * step);
  match.costs = random.costMaps(edge_count + 1, match.grid.states, 0.1);
  return match;
}

/// Every chain under every pose.
void expectGloballyOptimal(const Match& match) {
  ChainSolverWorkspace workspace;
  const PoseMatch found = searchPose(match.segment, match.model, match.previous, match.poses,
                                     match.grid, match.costs, workspace);
  cv::Mat1d energies(match.poses.orientations, match.poses.scales);
  long long chains = 0;
  for (int row = 0; row < energies.rows; ++row) {
    for (int column = 0; column < energies.cols; ++column) {
      const SegmentPose pose = match.poses.at(row, column);
      const auto all =
          brute_force::enumerateChains(match.costs, springsOf(match.segment, pose, match.grid));
      chains += all.chains;
      energies(row, column) = all.cost + temporalCostByHand(match.model, match.previous, pose);
    }
  }
  const double states = match.grid.states.area();
  EXPECT_EQ(15.0 * std::pow(states, double(match.costs.size())), double(chains));
  EXPECT_EQ("", firstDifference(energies, found.energies, 1e-4));
  double least = 0.0;
  cv::minMaxLoc(energies, &least);
  ASSERT_LT(least, kInfinity) << "this problem tests nothing";
  ASSERT_TRUE(found.found());
  EXPECT_NEAR(least, found.energy(), 1e-4);
  const SegmentPose pose = match.poses.at(found.row, found.column);
  const double energy =
      brute_force::energyOf(match.costs, springsOf(match.segment, pose, match.grid), found.states);
  EXPECT_NEAR(least, energy + temporalCostByHand(match.model, match.previous, pose), 1e-4);
}

TEST(SearchPose, isGloballyOptimalOnTheSearchedGrid) {
  RandomInputs random(2);
  for (int repeat = 0; repeat < 8; ++repeat) {
    SCOPED_TRACE("three parts, repeat " + std::to_string(repeat));
    expectGloballyOptimal(tinyMatch(random, 2, 2));
  }
  for (int repeat = 0; repeat < 8; ++repeat) {
    SCOPED_TRACE("four parts, repeat " + std::to_string(repeat));
    expectGloballyOptimal(tinyMatch(random, 1, 3));
  }
}

TEST(SearchPose, findsTheTurnAndScaleThatTheCostsShow) {
  const SegmentLayout segment = chainOf({{40.0, 0.0, 0.01, 0.01}, {40.0, 0.5, 0.01, 0.01}});
  SegmentModel model;
  model.orientation_sigma = model.scale_sigma = 10.0;
  const SegmentPose previous{0.2, 1.0};
  const PoseGrid poses{previous, 5, 0.1, 3, 0.05};
  const std::vector<cv::Point2d> truth = placed(segment, {0.4, std::exp(0.05), {50, 50}});
  const CandidateGrid grid = makeCandidateGrid(truth, 8.0, 1, 6.0);
  std::vector<cv::Mat1f> costs(3);
  for (cv::Mat1f& map : costs) {
    map = cv::Mat1f(grid.states, 20.0F);
    map(grid.states.height / 2, grid.states.width / 2) = 0.0F;
  }
  ChainSolverWorkspace workspace;
  const PoseMatch match = searchPose(segment, model, previous, poses, grid, costs, workspace);
  EXPECT_EQ(4, match.row);
  EXPECT_EQ(2, match.column);
  ASSERT_TRUE(match.found());
  for (const cv::Point& state : match.states) EXPECT_EQ(cv::Point(grid.states / 2), state);
}

TEST(SearchPose, findsNothingWhereNoChainIsAllowed) {
  RandomInputs random(3);
  Match match = tinyMatch(random, 1, 2);
  match.costs[1].setTo(kInfinity);
  ChainSolverWorkspace workspace;
  const PoseMatch found = searchPose(match.segment, match.model, match.previous, match.poses,
                                     match.grid, match.costs, workspace);
  EXPECT_FALSE(found.found());
  EXPECT_EQ("", firstDifference(cv::Mat1d(5, 3, kInfinity), found.energies));
}

}  // namespace
}  // namespace chain_tracker
