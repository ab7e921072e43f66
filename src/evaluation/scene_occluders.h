// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/evaluation/scene_options.h"
#include "scene_painting.h"

namespace chain_tracker {

/// Textured things that pass straight over the object, one after the other, in equal intervals over
/// the clip. Each goes with the object while it passes, so that it covers the object's middle for
/// exactly the frames asked for.
class Occluders {
 public:
  /// `object_length`: at scale 1 [px].
  Occluders(const SceneOptions& options, double object_length, cv::RNG& rng);
  /// `middle`, `scale`: of the object in that frame.
  void paint(double frame, const cv::Point2d& middle, double scale, Layer& layer) const;

 private:
  struct Passage {
    Sprite sprite;
    double meeting;         ///< when its middle is over the object's [frame]
    cv::Point2d direction;  ///< unit vector
  };

  std::vector<Passage> passages_;
  double width_ = 0.0;  ///< at scale 1 [px]
  double step_ = 0.0;   ///< over the object, at scale 1 [px/frame]
};

}  // namespace chain_tracker
