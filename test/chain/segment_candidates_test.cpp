// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/segment_candidates.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "chain_tracker/chain/chain_model.h"
#include "support/lattice_candidates.h"
#include "support/random_inputs.h"

namespace chain_tracker {
namespace {

TEST(PlaceCandidates, nodesLieWhereTheGridHasThem) {
  ChainModel model;
  model.segment_per_edge = true;
  const std::vector<cv::Point2d> points = {{20.0, 30.0}, {120.0, 40.0}, {200.0, 90.0}};
  const std::vector<SegmentLayout> segments =
      layOut(forPolyline(model, points.size()), points).segments;
  SegmentCandidates candidates;  // of the segment before
  for (const SegmentLayout& segment : segments) {
    std::vector<cv::Point2d> centers;
    for (const PartLayout& part : segment.parts) {
      centers.push_back(segment.image_from_segment.apply(part.position));
    }
    const CandidateGrid grid = gridAround(centers, 12.0, 3, 20.0);
    const cv::Point2d end(130.0, 50.0);
    placeCandidates(segment, grid, end, candidates);
    const size_t joint = segment.entry ? 1 : 0;
    ASSERT_EQ(segment.parts.size() + joint + (segment.exit ? 1 : 0), candidates.origins.size());
    EXPECT_EQ(grid.states, candidates.states);
    for (size_t k = 0; k < centers.size(); ++k) {
      EXPECT_EQ(grid.positionOf(k, {0.0, 0.0}), candidates.positionOf(joint + k, {0.0, 0.0}));
    }
    if (!segment.exit) continue;
    const cv::Point2d middle(grid.states.width / 2, grid.states.height / 2);
    const cv::Point2d nearest = candidates.positionOf(candidates.origins.size() - 1, middle);
    EXPECT_LE(std::abs(nearest.x - end.x), 1.5);
    EXPECT_LE(std::abs(nearest.y - end.y), 1.5);
  }
}

TEST(TakeMiddleStates, areTheSameStatesElsewhere) {
  RandomInputs random(5);
  SegmentCandidates all;
  all.step = 2;
  all.states = {11, 13};
  all.origins = random.points(3, 0.0, 100.0);
  all.costs = random.costMaps(3, all.states);
  SegmentCandidates middle;
  for (const int most : {1, 4, 12, 20}) {
    takeMiddleStates(all, most, middle);
    EXPECT_EQ(cv::Size(std::min(most, 11), std::min(most, 13)), middle.states);
    const cv::Point first(cv::Size(all.states - middle.states) / 2);
    for (size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(all.positionOf(k, cv::Point2d(first)), middle.positionOf(k, {0.0, 0.0}));
      EXPECT_EQ(all.costs[k](first), middle.costs[k](0, 0));
      EXPECT_EQ(middle.states, middle.costs[k].size());
    }
  }
}

}  // namespace
}  // namespace chain_tracker
