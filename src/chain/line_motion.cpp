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

/// Walks along a polyline of at least two points and straight on beyond its end.
class Walk {
 public:
  explicit Walk(const std::vector<cv::Point2d>& way) : way_(way), place_(way.front()) {
    const size_t steps = std::min<size_t>(kEndSteps, way.size() - 1);
    const cv::Point2d end = way.back() - way[way.size() - 1 - steps];
    const double length = cv::norm(end);
    if (length > 0.0) ahead_ = end / length;
  }

  const cv::Point2d& place() const { return place_; }

  void go(double length) {
    while (next_ < way_.size()) {
      const cv::Point2d edge = way_[next_] - place_;
      const double left = cv::norm(edge);
      if (length < left) {
        place_ += edge * (length / left);
        return;
      }
      length -= left;
      place_ = way_[next_++];
    }
    place_ += length * ahead_;
  }

 private:
  const std::vector<cv::Point2d>& way_;
  cv::Point2d place_;
  cv::Point2d ahead_;
  size_t next_ = 1;
};

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

double lengthOf(const std::vector<cv::Point2d>& polyline) {
  double length = 0.0;
  for (size_t k = 1; k < polyline.size(); ++k) length += cv::norm(polyline[k] - polyline[k - 1]);
  return length;
}

void layAlong(const std::vector<cv::Point2d>& way, const std::vector<double>& lengths,
              bool backwards, ChainState& line) {
  Walk walk(way);
  const size_t edges = lengths.size();
  for (size_t k = 0; k <= edges; ++k) {
    PartState& part = line.parts[backwards ? edges - k : k];
    part.position = walk.place();
    part.visible = true;
    if (k < edges) walk.go(lengths[backwards ? edges - 1 - k : k]);
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
