// SPDX-License-Identifier: BSD-3-Clause
/// Where the nodes of a segment are looked for: its parts, and the joints at its ends.
#pragma once

#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/part_costs.h"

namespace chain_tracker {

/// Where the nodes of a segment may be, and what that costs. The joint between two segments has the
/// same states in both.
struct SegmentCandidates {
  int step = 1;                      ///< of the lattices [px]
  cv::Size states;                   ///< of every node: columns and rows
  std::vector<cv::Point2d> origins;  ///< position of each node's state (0, 0) [px]
  std::vector<cv::Mat1f> costs;      ///< of each node's states; a joint's are zero

  /// Position of a node's state, which may lie between lattice points [px].
  cv::Point2d positionOf(size_t node, const cv::Point2d& state) const {
    return origins[node] + state * double(step);
  }
};

/// `candidates` become those of the grid, with those of a joint at `end` [px] on its lattice. Their
/// costs, and the origin of a joint at the beginning, are left to the caller.
void placeCandidates(const SegmentLayout& segment, const CandidateGrid& grid,
                     const cv::Point2d& end, SegmentCandidates& candidates);

/// `middle` becomes the states in the middle, at most `most` along a side; the costs are views of
/// the same maps.
void takeMiddleStates(const SegmentCandidates& candidates, int most, SegmentCandidates& middle);

}  // namespace chain_tracker
