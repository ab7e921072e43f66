// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/object_shape.h"

#include <utility>

namespace chain_tracker {
namespace {

CarriedPoint between(const CarriedPoint& a, const CarriedPoint& b) {
  return {0.5 * (a.position + b.position), 0.5 * (a.confidence + b.confidence),
          a.visible && b.visible};
}

/// The first point of a segment, at `index`, is the last one of the segment before.
void joinPoints(std::size_t index, std::vector<CarriedPoint>& points) {
  const auto first = points.begin() + static_cast<std::ptrdiff_t>(index);
  *(first - 1) = between(*(first - 1), *first);
  points.erase(first);
}

}  // namespace

ObjectShape::ObjectShape(std::vector<SegmentLayout> segments) : segments_(std::move(segments)) {
  for (const SegmentLayout& segment : segments_) shapes_.emplace_back(segment);
}

void ObjectShape::carry(ChainState& state) {
  state.points.clear();
  state.outline.clear();
  for (std::size_t m = 0; m < segments_.size(); ++m) {
    const SegmentState& segment = state.segments[m];
    const SegmentParts parts(state, segment);
    orient(m, state);
    const std::size_t first = state.points.size();
    shapes_[m].addPoints(segment, parts, state.points);
    if (m > 0) joinPoints(first, state.points);
    shapes_[m].addOutline(segment, parts, state.outline);
  }
  const bool is_one = segments_.size() == 1;
  if (!is_one || shapes_.front().outlineIsHull()) hull_.replace(state.outline);
  state.box = is_one ? shapes_.front().box(state.segments.front(), state.outline)
                     : uprightBounds(state.outline);
}

void ObjectShape::orient(std::size_t m, ChainState& state) const {
  const SegmentState& segment = state.segments[m];
  const SegmentParts parts(state, segment);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    PartState& part = state.parts[static_cast<std::size_t>(segment.first_part) + k];
    part.orientation = partOrientation(segments_[m], segment, parts, k);
    part.side = segments_[m].parts[k].side * segment.image_from_segment.scale;
  }
}

}  // namespace chain_tracker
