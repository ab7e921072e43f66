// SPDX-License-Identifier: BSD-3-Clause
#include "line_motion.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace chain_tracker {
namespace {

/// Steps at an end whose mean tells where it leads.
constexpr int kEndSteps = 3;

/// Every part to where the one `places` behind it is.
void slideOnwards(int places, std::vector<PartState>& parts) {
  const int steps = std::min(kEndSteps, static_cast<int>(parts.size()) - 1);
  const PartState last = parts.back();
  const cv::Point2d step = (last.position - (parts.end() - 1 - steps)->position) / steps;
  std::rotate(parts.begin(), parts.begin() + places, parts.end());
  for (int beyond = 1; beyond <= places; ++beyond) {
    PartState& part = *(parts.end() - 1 - places + beyond);
    part = last;
    part.position += beyond * step;
    part.visible = true;
  }
}

}  // namespace

int hiddenEnd(const ChainState& line) {
  const auto is_visible = [](const PartState& part) { return part.visible; };
  const auto first = std::find_if(line.parts.begin(), line.parts.end(), is_visible);
  if (first == line.parts.end()) return 0;
  const auto last = std::find_if(line.parts.rbegin(), line.parts.rend(), is_visible);
  const auto before = static_cast<int>(first - line.parts.begin());
  const auto behind = static_cast<int>(last - line.parts.rbegin());
  return before > behind ? before : -behind;
}

void slide(int places, ChainState& line) {
  if (places < 0) std::reverse(line.parts.begin(), line.parts.end());
  slideOnwards(std::abs(places), line.parts);
  if (places < 0) std::reverse(line.parts.begin(), line.parts.end());
}

void reverse(ChainState& line) {
  std::reverse(line.parts.begin(), line.parts.end());
  for (SegmentState& segment : line.segments) {
    Similarity& pose = segment.image_from_segment;
    pose.angle = wrapAngle(pose.angle + CV_PI);
  }
}

}  // namespace chain_tracker
