// SPDX-License-Identifier: BSD-3-Clause
#include "chain_nodes.h"

namespace chain_tracker {

cv::Point2d jointPosition(const std::vector<SegmentLayout>& layout, const ChainState& state,
                          size_t m) {
  return 0.5 * (state.segments[m].image_from_segment.apply(*layout[m].exit) +
                state.segments[m + 1].image_from_segment.apply(*layout[m + 1].entry));
}

std::vector<cv::Point2d> nodePositions(const std::vector<SegmentLayout>& layout,
                                       const ChainState& state, size_t m) {
  const SegmentState& segment = state.segments[m];
  const auto first = state.parts.begin() + segment.first_part;
  std::vector<cv::Point2d> positions;
  positions.reserve(layout[m].edges.size() + 1);
  if (layout[m].entry) positions.push_back(jointPosition(layout, state, m - 1));
  for (auto part = first; part != first + segment.part_count; ++part) {
    positions.push_back(part->position);
  }
  if (layout[m].exit) positions.push_back(jointPosition(layout, state, m));
  return positions;
}

std::vector<bool> nodesHidden(const SegmentLayout& segment, const ChainState& state, size_t m) {
  const auto first = state.parts.begin() + state.segments[m].first_part;
  std::vector<bool> hidden;
  for (auto part = first; part != first + state.segments[m].part_count; ++part) {
    hidden.push_back(!part->visible);
  }
  if (segment.entry) hidden.insert(hidden.begin(), hidden.front());
  if (segment.exit) hidden.push_back(hidden.back());
  return hidden;
}

}  // namespace chain_tracker
