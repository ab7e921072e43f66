// SPDX-License-Identifier: BSD-3-Clause
/// Where a state has the nodes of a segment's chain: its parts, and the joints at its ends.
#pragma once

#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/chain_state.h"

namespace chain_tracker {

/// Of the joint of segments `m` and `m + 1` [px]: halfway between where the two have it.
cv::Point2d jointPosition(const std::vector<SegmentLayout>& layout, const ChainState& state,
                          size_t m);

/// `positions` become those of segment `m` [px], from end to end. Both segments at a joint say the
/// same.
void takeNodePositions(const std::vector<SegmentLayout>& layout, const ChainState& state, size_t m,
                       std::vector<cv::Point2d>& positions);

/// The same of whether they are hidden. A joint is as the part beside it.
void takeNodesHidden(const SegmentLayout& segment, const SegmentParts& parts,
                     std::vector<bool>& hidden);

}  // namespace chain_tracker
