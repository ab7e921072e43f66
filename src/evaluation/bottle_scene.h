// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "chain_tracker/evaluation/synthetic_scene.h"
#include "scene_painting.h"

namespace chain_tracker {

/// A bottle with cap and label that shifts, turns to and fro and changes its size. Its points are
/// its two ends, cap first.
class BottleScene : public SyntheticScene {
 public:
  explicit BottleScene(const SceneOptions& options);
  std::string model() const override { return "bottle"; }
  SceneFrame render(int index) const override;

 private:
  Similarity poseAt(int index) const;

  SceneOptions options_;
  cv::RNG rng_;
  cv::Mat3b background_;
  Sprite bottle_;
  SmoothMotion x_;
  SmoothMotion y_;
  SmoothMotion turn_;
  SmoothMotion growth_;
};

}  // namespace chain_tracker
