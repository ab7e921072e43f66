// SPDX-License-Identifier: BSD-3-Clause
/// Candidates of parts on a lattice.
#pragma once

#include <vector>

#include "chain_tracker/chain/part_costs.h"
#include "chain_tracker/chain/segment_candidates.h"

namespace chain_tracker {

/// As placeCandidateGrid() has it.
inline CandidateGrid gridAround(const std::vector<cv::Point2d>& centers, double side, int step,
                                double radius) {
  CandidateGrid grid;
  placeCandidateGrid(centers, side, step, radius, grid);
  return grid;
}

/// Of a segment without joints, as its grid says.
inline SegmentCandidates candidatesOn(const CandidateGrid& grid,
                                      const std::vector<cv::Mat1f>& costs) {
  SegmentCandidates candidates{grid.lattice.step, grid.states, {}, costs};
  for (std::size_t k = 0; k < grid.corners.size(); ++k) {
    candidates.origins.push_back(grid.positionOf(k, {0.0, 0.0}));
  }
  return candidates;
}

}  // namespace chain_tracker
