// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "camera_effects.h"
#include "chain_tracker/evaluation/synthetic_scene.h"
#include "scene_object.h"
#include "scene_occluders.h"

namespace chain_tracker {

/// How a scene comes about: a place and an object in it.
struct SceneRecipe {
  std::string name;
  std::string model;  ///< a model of config/models that tracks it, or auto
  cv::Mat3b (*paint_background)(const cv::Size&, cv::RNG&);
  SceneObjectPtr (*make_object)(const SceneOptions&, cv::RNG&);
};

/// One object that moves in front of a background, under a camera.
class ComposedScene : public SyntheticScene {
 public:
  /// The options must be without faults.
  ComposedScene(const SceneRecipe& recipe, const SceneOptions& options);

  std::string model() const override { return model_; }
  SceneFrame render(int index) const override;
  cv::Mat3b renderWithoutObject(int index) const override;

 private:
  ObjectTruth truthAt(double time) const;
  void addClutter(cv::RNG& rng);
  /// Number of pictures that a motion of `distance` px during the exposure needs.
  static int exposuresFor(double distance);
  double blur() const { return options_.blur.value_or(habits_.blur); }
  double shadow() const { return options_.shadow.value_or(habits_.shadow); }
  /// How far things move while the shutter is open [px].
  double objectTravel(double frame) const;
  double surroundingsTravel(double frame) const;

  cv::Mat3b backgroundAt(double frame) const;
  Layer occludersAt(double frame) const;
  cv::Mat3b paintSurroundings(double frame) const;
  void paintObject(double frame, cv::Mat3b& canvas) const;
  cv::Mat3b expose(double frame, bool with_object) const;
  cv::Mat3b takePicture(int index, bool with_object) const;

  SceneOptions options_;
  std::string model_;
  double margin_ = 0.0;  ///< of the background around the image, for its own motion [px]
  cv::RNG rng_;
  cv::Mat3b background_;
  SceneObjectPtr object_;
  SceneHabits habits_;
  PoseMotion motion_;
  /// What is not always there draws from sources of its own: the rest stays as it is without.
  cv::RNG extras_rng_;
  cv::RNG occluders_rng_;
  SmoothMotion background_x_;
  SmoothMotion background_y_;
  IlluminationDrift illumination_;
  Occluders occluders_;
  double first_scale_ = 1.0;
  std::vector<cv::Point2d> first_points_;
};

}  // namespace chain_tracker
