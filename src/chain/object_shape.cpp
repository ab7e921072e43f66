// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/object_shape.h"

#include <algorithm>
#include <utility>

namespace chain_tracker {
namespace {

std::vector<PartState> partsOf(const SegmentState& segment, const ChainState& state) {
  const auto first = state.parts.begin() + segment.first_part;
  return {first, first + segment.part_count};
}

CarriedPoint between(const CarriedPoint& a, const CarriedPoint& b) {
  return {0.5 * (a.position + b.position), 0.5 * (a.confidence + b.confidence),
          a.visible && b.visible};
}

/// Appends the points of the next segment, whose first is the last one before.
void joinPoints(const std::vector<CarriedPoint>& next, std::vector<CarriedPoint>& points) {
  if (points.empty()) {
    points = next;
    return;
  }
  points.back() = between(points.back(), next.front());
  points.insert(points.end(), next.begin() + 1, next.end());
}

}  // namespace

ObjectShape::ObjectShape(std::vector<SegmentLayout> segments) : segments_(std::move(segments)) {
  for (const SegmentLayout& segment : segments_) shapes_.emplace_back(segment);
}

void ObjectShape::carry(ChainState& state) const {
  state.points.clear();
  state.outline.clear();
  for (std::size_t m = 0; m < segments_.size(); ++m) {
    const SegmentState& segment = state.segments[m];
    const std::vector<PartState> parts = partsOf(segment, state);
    const std::vector<double> orientations = partOrientations(segments_[m], segment, parts);
    for (std::size_t k = 0; k < parts.size(); ++k) {
      PartState& part = state.parts[static_cast<std::size_t>(segment.first_part) + k];
      part.orientation = orientations[k];
      part.side = segments_[m].parts[k].side * segment.image_from_segment.scale;
    }
    joinPoints(shapes_[m].points(segment, parts), state.points);
    const std::vector<cv::Point2d> corners = shapes_[m].outline(segment, parts);
    state.outline.insert(state.outline.end(), corners.begin(), corners.end());
  }
  if (segments_.size() == 1) {
    state.box = shapes_.front().box(state.segments.front(), state.parts);
  } else {
    state.outline = hullOf(state.outline);
    state.box = uprightBounds(state.outline);
  }
}

}  // namespace chain_tracker
