// SPDX-License-Identifier: BSD-3-Clause
/// Rendered scenes whose exact truth is known: textured, anti-aliased objects moving over textured
/// backgrounds. The same name, options and frame number always give the same picture.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/image/pixel_geometry.h"

namespace chain_tracker {

struct SceneOptions {
  int frames = 300;         ///< length of the motion, >= 1
  std::uint32_t seed = 1;   ///< of texture, background and motion
  cv::Size size{640, 480};  ///< of the image [px], at least 64 x 64
  double noise = 2.0;       ///< standard deviation of the sensor noise [grey levels], >= 0
};

struct SceneFrame {
  cv::Mat3b image;                  ///< BGR
  std::vector<cv::Point2d> points;  ///< material points of the object [px]
  Similarity image_from_object;     ///< exact pose
};

class SyntheticScene {
 public:
  virtual ~SyntheticScene() = default;

  /// Name of the model that tracks this object.
  virtual std::string model() const = 0;

  /// Frame `index`, in [0, options.frames). O(pixels).
  virtual SceneFrame render(int index) const = 0;
};

/// Names that makeScene() knows.
std::vector<std::string> sceneNames();

/// Throws std::invalid_argument naming the option, its value and what is allowed.
std::unique_ptr<SyntheticScene> makeScene(const std::string& name, const SceneOptions& options);

}  // namespace chain_tracker
