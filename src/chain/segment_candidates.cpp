// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/segment_candidates.h"

#include <algorithm>

namespace chain_tracker {

void placeCandidates(const SegmentLayout& segment, const CandidateGrid& grid,
                     const cv::Point2d& end, SegmentCandidates& candidates) {
  candidates.step = grid.lattice.step;
  candidates.states = grid.states;
  candidates.origins.clear();
  if (segment.entry) candidates.origins.emplace_back();
  for (size_t k = 0; k < segment.parts.size(); ++k) {
    candidates.origins.push_back(grid.positionOf(k, {0.0, 0.0}));
  }
  if (segment.exit) candidates.origins.push_back(grid.originAround(end));
}

void takeMiddleStates(const SegmentCandidates& candidates, int most, SegmentCandidates& middle) {
  const cv::Size& all = candidates.states;
  middle.step = candidates.step;
  middle.states = {std::min(all.width, most), std::min(all.height, most)};
  const cv::Point first(cv::Size(all - middle.states) / 2);
  middle.origins.clear();
  for (const cv::Point2d& origin : candidates.origins) {
    middle.origins.push_back(origin + cv::Point2d(first) * candidates.step);
  }
  middle.costs.clear();
  for (const cv::Mat1f& map : candidates.costs) {
    middle.costs.push_back(map(cv::Rect(first, middle.states)));
  }
}

}  // namespace chain_tracker
