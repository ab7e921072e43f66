// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "scene_object.h"

namespace chain_tracker {

/// One sprite that keeps its shape.
class RigidObject : public SceneObject {
 public:
  /// `points`, `outline`: material points and corners of the silhouette, in the object's frame.
  RigidObject(Sprite sprite, std::vector<cv::Point2d> points, std::vector<cv::Point2d> outline,
              const SceneHabits& habits)
      : sprite_(std::move(sprite)),
        points_(std::move(points)),
        outline_(std::move(outline)),
        habits_(habits) {}

  SceneHabits habits() const override { return habits_; }
  double length() const override;
  double radius() const override { return 0.5 * length(); }
  ObjectTruth truthAt(const ObjectState& state) const override;
  void paint(const ObjectState& state, Layer& layer) const override;
  void paintDecoy(const Similarity& image_from_decoy, cv::RNG& rng, Layer& layer) const override;

 private:
  Sprite sprite_;
  std::vector<cv::Point2d> points_;
  std::vector<cv::Point2d> outline_;
  SceneHabits habits_;
};

/// Images of all points.
std::vector<cv::Point2d> transformed(const std::vector<cv::Point2d>& points,
                                     const Similarity& image_from_object);

}  // namespace chain_tracker
