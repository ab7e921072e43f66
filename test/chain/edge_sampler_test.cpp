// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/edge_sampler.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "support/brute_force.h"
#include "support/lattice_candidates.h"
#include "support/random_inputs.h"
#include "support/spring_chain.h"

namespace chain_tracker {
namespace {

/// All pairs of states of neighbouring parts; some edges are alike, some only nearly so.
TEST(EdgeSampler, costWhatTheSpringsCostBetweenTheCandidates) {
  RandomInputs random(1);
  const SegmentLayout segment = chainOf({{14.0, 0.3, 0.1, 0.2},
                                         {11.0, CV_PI, 0.1, 0.2},
                                         {14.0, 0.3, 0.1, 0.2},
                                         {11.0, -CV_PI, 0.1, 0.2},
                                         {14.0, 0.3, 0.2, 0.2},
                                         {14.0, 0.3, 0.1, 0.3},
                                         {14.0, 0.5, 0.1, 0.2},
                                         {14.5, 0.3, 0.1, 0.2}});
  EdgeSampler sampler;
  ChainEdges edges;  // from step to step
  for (int step : {1, 3, 2}) {
    const SegmentPose pose{0.7, 1.1};
    const Similarity transform{0.6, 1.15, {50, 50}};
    std::vector<cv::Point2d> centers = placed(segment, transform);
    for (cv::Point2d& center : centers) center += random.point(-3.0, 3.0);
    const CandidateGrid grid = gridAround(centers, 10.0, step, 2.0 * step);
    SegmentCandidates candidates = candidatesOn(grid, {});
    candidates.origins.back() += cv::Point2d(0.3, -0.4);  // a lattice of its own
    sampler.sample(segment, candidates, pose, edges);
    ASSERT_EQ(segment.edges.size(), edges.size());
    const auto spring = springsOf(segment, pose, candidates);
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

/// Each edge is like the one before, the last one not like the first.
TEST(EdgeSampler, leaveNoEdgeOfNearlyEqualOnesOut) {
  const SegmentLayout segment = chainOf(
      {{14.0, 0.3, 0.1, 0.2}, {14.0, 0.3 + 0.9e-6, 0.1, 0.2}, {14.0, 0.3 + 1.8e-6, 0.1, 0.2}});
  const CandidateGrid grid = gridAround(placed(segment, {0.0, 1.0, {50, 50}}), 10.0, 1, 6.0);
  EdgeSampler sampler;
  ChainEdges edges;
  sampler.sample(segment, candidatesOn(grid, {}), {0.0, 1.0}, edges);
  ASSERT_EQ(3U, edges.size());
  for (size_t k = 0; k < edges.size(); ++k) EXPECT_FALSE(edges[k].empty());
}

}  // namespace
}  // namespace chain_tracker
