// SPDX-License-Identifier: BSD-3-Clause
#include "state_motion.h"

#include <cmath>
#include <vector>

#include "chain_tracker/image/pixel_geometry.h"

namespace chain_tracker {

cv::Point2d middleOf(const ChainState& state) {
  cv::Point2d middle;
  for (const PartState& part : state.parts) {
    middle += part.position / static_cast<double>(state.parts.size());
  }
  return middle;
}

double extentOf(const ChainState& state) {
  double extent = 0.0;
  std::vector<cv::Point2d> centers;
  for (const SegmentState& segment : state.segments) {
    const auto first = state.parts.begin() + segment.first_part;
    centers.clear();
    for (auto part = first; part != first + segment.part_count; ++part) {
      centers.push_back(part->position);
    }
    const cv::Rect2d bounds = uprightBounds(centers);
    extent += std::hypot(bounds.width, bounds.height);
  }
  return extent;
}

Similarity rigidMotion(double angle, const cv::Point2d& center, const cv::Point2d& target) {
  return {angle, 1.0, target - Similarity{angle, 1.0, {}}.apply(center)};
}

void moveSegment(const Similarity& motion, size_t segment, ChainState& state) {
  SegmentState& moved = state.segments[segment];
  const auto first = state.parts.begin() + moved.first_part;
  for (auto part = first; part != first + moved.part_count; ++part) {
    part->position = motion.apply(part->position);
    part->orientation = wrapAngle(part->orientation + motion.angle);
  }
  Similarity& pose = moved.image_from_segment;
  pose = {wrapAngle(pose.angle + motion.angle), pose.scale, motion.apply(pose.translation)};
}

void turnWhole(double angle, ChainState& state) {
  const cv::Point2d middle = middleOf(state);
  const Similarity turn = rigidMotion(angle, middle, middle);
  for (size_t m = 0; m < state.segments.size(); ++m) moveSegment(turn, m, state);
}

}  // namespace chain_tracker
