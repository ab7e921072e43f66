// SPDX-License-Identifier: BSD-3-Clause
#include "rigid_object.h"

#include <algorithm>

namespace chain_tracker {

double shorterSide(const SceneOptions& options) {
  return std::min(options.size.width, options.size.height);
}

std::vector<cv::Point2d> transformed(const std::vector<cv::Point2d>& points,
                                     const Similarity& image_from_object) {
  std::vector<cv::Point2d> images;
  images.reserve(points.size());
  for (const cv::Point2d& point : points) images.push_back(image_from_object.apply(point));
  return images;
}

double RigidObject::length() const {
  double farthest = 0.0;
  for (const cv::Point2d& corner : outline_) farthest = std::max(farthest, cv::norm(corner));
  return 2.0 * farthest;
}

ObjectTruth RigidObject::truthAt(const ObjectState& state) const {
  return {transformed(points_, state.image_from_object),
          {state.image_from_object},
          uprightBounds(transformed(outline_, state.image_from_object))};
}

void RigidObject::paint(const ObjectState& state, Layer& layer) const {
  sprite_.paint(state.image_from_object, layer);
}

void RigidObject::paintDecoy(const Similarity& image_from_decoy, cv::RNG& rng, Layer& layer) const {
  sprite_.piece(rng.uniform(0.3, 0.5), rng).paint(image_from_decoy, layer);
}

}  // namespace chain_tracker
