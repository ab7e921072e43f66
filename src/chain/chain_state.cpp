// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/chain_state.h"

#include <cmath>

namespace chain_tracker {

Similarity meanPose(const ChainState& state) {
  Similarity mean;
  cv::Point2d direction;
  double log_scale = 0.0;
  double weight = 0.0;
  for (const SegmentState& segment : state.segments) {
    const Similarity& pose = segment.image_from_segment;
    const double parts = segment.part_count;
    mean.translation += parts * pose.translation;
    direction += parts * cv::Point2d(std::cos(pose.angle), std::sin(pose.angle));
    log_scale += parts * std::log(pose.scale);
    weight += parts;
  }
  mean.translation *= 1.0 / weight;
  mean.angle = directionOf(direction);
  mean.scale = std::exp(log_scale / weight);
  return mean;
}

}  // namespace chain_tracker
