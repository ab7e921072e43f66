// SPDX-License-Identifier: BSD-3-Clause
/// What a scene is about: an object with a shape that may change, in a frame of its own.
#pragma once

#include <memory>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/evaluation/scene_options.h"
#include "chain_tracker/image/pixel_geometry.h"
#include "scene_motion.h"
#include "scene_painting.h"

namespace chain_tracker {

/// What suits the object where the options leave it open, and how it moves.
struct SceneHabits {
  MotionRange motion;
  double blur = 0.0;
  int clutter = 2;
  double shadow = 0.3;
};

/// Where the object is, in the image.
struct ObjectTruth {
  std::vector<cv::Point2d> points;
  std::vector<Similarity> segments;  ///< empty: one, fitted to the points of frame 0
  cv::Rect2d box;
};

class SceneObject {
 public:
  virtual ~SceneObject() = default;

  virtual SceneHabits habits() const = 0;
  /// At scale 1 [px]: the object's own length, and from its origin to the farthest point of it and
  /// of what moves with it.
  virtual double length() const = 0;
  virtual double radius() const { return length(); }

  virtual ObjectTruth truthAt(const ObjectState& state) const = 0;
  virtual void paint(const ObjectState& state, Layer& layer) const = 0;
  /// What moves with the object without being it, such as the face around the lips.
  virtual void paintCompanions(const ObjectState& /*state*/, Layer& /*layer*/) const {}
  /// Something else in the object's own colours, at rest.
  virtual void paintDecoy(const Similarity& image_from_decoy, cv::RNG& rng, Layer& layer) const = 0;
};

using SceneObjectPtr = std::unique_ptr<SceneObject>;

/// One per scene; each draws its textures and the course of its bending from `rng`.
SceneObjectPtr makeBottle(const SceneOptions& options, cv::RNG& rng);
SceneObjectPtr makeBox(const SceneOptions& options, cv::RNG& rng);
SceneObjectPtr makeRobotArm(const SceneOptions& options, cv::RNG& rng);
SceneObjectPtr makeFingerPair(const SceneOptions& options, cv::RNG& rng);
SceneObjectPtr makeCable(const SceneOptions& options, cv::RNG& rng);
SceneObjectPtr makeSuture(const SceneOptions& options, cv::RNG& rng);
SceneObjectPtr makeGuitarString(const SceneOptions& options, cv::RNG& rng);
SceneObjectPtr makeLips(const SceneOptions& options, cv::RNG& rng);
SceneObjectPtr makePlasticBag(const SceneOptions& options, cv::RNG& rng);

/// The image's shorter side [px], of which objects are fractions.
double shorterSide(const SceneOptions& options);

}  // namespace chain_tracker
