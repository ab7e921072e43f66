// SPDX-License-Identifier: BSD-3-Clause
#include "chain_nodes.h"

namespace chain_tracker {

cv::Point2d jointPosition(const std::vector<SegmentLayout>& layout, const ChainState& state,
                          size_t m) {
  return 0.5 * (state.segments[m].image_from_segment.apply(*layout[m].exit) +
                state.segments[m + 1].image_from_segment.apply(*layout[m + 1].entry));
}

void takeNodePositions(const std::vector<SegmentLayout>& layout, const ChainState& state, size_t m,
                       std::vector<cv::Point2d>& positions) {
  positions.clear();
  if (layout[m].entry) positions.push_back(jointPosition(layout, state, m - 1));
  for (const PartState& part : SegmentParts(state, state.segments[m])) {
    positions.push_back(part.position);
  }
  if (layout[m].exit) positions.push_back(jointPosition(layout, state, m));
}

void takeNodesHidden(const SegmentLayout& segment, const SegmentParts& parts,
                     std::vector<bool>& hidden) {
  hidden.clear();
  if (segment.entry) hidden.push_back(!parts[0].visible);
  for (const PartState& part : parts) hidden.push_back(!part.visible);
  if (segment.exit) hidden.push_back(hidden.back());
}

}  // namespace chain_tracker
