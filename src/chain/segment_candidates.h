// SPDX-License-Identifier: BSD-3-Clause
/// Where the nodes of a segment are looked for, as the matcher takes it.
#pragma once

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/chain_matcher.h"
#include "chain_tracker/chain/part_costs.h"

namespace chain_tracker {

/// The candidates of the grid, with those of a joint at `end` [px] on its lattice. The costs of the
/// parts' states, and the origin of a joint at the beginning, are left to the caller.
SegmentCandidates candidatesOf(const SegmentLayout& segment, const CandidateGrid& grid,
                               const cv::Point2d& end);

/// The states in the middle, at most `most` along a side; the costs are views of the same maps.
SegmentCandidates middleStates(const SegmentCandidates& candidates, int most);

}  // namespace chain_tracker
