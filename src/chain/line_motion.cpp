// SPDX-License-Identifier: BSD-3-Clause
#include "line_motion.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <iterator>
#include <vector>

namespace chain_tracker {
namespace {

/// Steps at an end whose mean tells where it leads.
constexpr int kEndSteps = 3;
/// Parts to each side that a smoothed line is the mean of.
constexpr std::ptrdiff_t kSmoothing = 2;

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

/// Of the steps from the place of `from` to that of `to`; none where these coincide.
cv::Point2d directionOf(const cv::Point2d& from, const cv::Point2d& to) {
  const double length = cv::norm(to - from);
  return length > 0.0 ? (to - from) / length : cv::Point2d();
}

}  // namespace

void slide(int places, ChainState& line) {
  if (places < 0) std::reverse(line.parts.begin(), line.parts.end());
  slideOnwards(std::abs(places), line.parts);
  if (places < 0) std::reverse(line.parts.begin(), line.parts.end());
}

void takeSeenStretch(const ChainState& line, std::vector<cv::Point2d>& stretch) {
  const auto is_visible = [](const PartState& part) { return part.visible; };
  const auto first = std::find_if(line.parts.begin(), line.parts.end(), is_visible);
  const auto last = std::find_if(line.parts.rbegin(), line.parts.rend(), is_visible).base();
  stretch.clear();
  for (auto part = first; part < last; ++part) {
    const std::ptrdiff_t reach =
        std::min({kSmoothing, std::distance(first, part), std::distance(part, last) - 1});
    cv::Point2d sum;
    for (auto near = part - reach; near <= part + reach; ++near) sum += near->position;
    stretch.push_back(sum / static_cast<double>(2 * reach + 1));
  }
}

cv::Point2d pointAlong(const std::vector<cv::Point2d>& way, double place) {
  const size_t steps = std::min<size_t>(kEndSteps, way.size() - 1);
  if (place < 0.0) return way.front() + place * directionOf(way.front(), way[steps]);
  for (size_t k = 1; k < way.size(); ++k) {
    const double edge = cv::norm(way[k] - way[k - 1]);
    if (place < edge) return way[k - 1] + (place / edge) * (way[k] - way[k - 1]);
    place -= edge;
  }
  return way.back() + place * directionOf(way[way.size() - 1 - steps], way.back());
}

void layAlong(const std::vector<cv::Point2d>& way, double start, const std::vector<double>& lengths,
              bool backwards, ChainState& line) {
  const size_t edges = lengths.size();
  for (size_t k = 0; k <= edges; ++k) {
    PartState& part = line.parts[backwards ? edges - k : k];
    part.position = pointAlong(way, start);
    part.visible = true;
    if (k < edges) start += lengths[backwards ? edges - 1 - k : k];
  }
}

bool liesReversed(const ChainState& line, const ChainState& before) {
  double as_is = 0.0;
  double reversed = 0.0;
  const size_t last = line.parts.size() - 1;
  for (size_t k = 0; k <= last; ++k) {
    as_is += cv::norm(line.parts[k].position - before.parts[k].position);
    reversed += cv::norm(line.parts[last - k].position - before.parts[k].position);
  }
  return reversed < as_is;
}

void reverse(ChainState& line) {
  std::reverse(line.parts.begin(), line.parts.end());
  for (SegmentState& segment : line.segments) {
    Similarity& pose = segment.image_from_segment;
    pose.angle = wrapAngle(pose.angle + CV_PI);
  }
}

}  // namespace chain_tracker
