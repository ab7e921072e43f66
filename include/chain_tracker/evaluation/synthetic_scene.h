// SPDX-License-Identifier: BSD-3-Clause
/// Rendered scenes whose exact truth is known: textured, anti-aliased objects moving over textured
/// backgrounds. The same name, options and frame number always give the same picture.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/evaluation/scene_options.h"
#include "chain_tracker/image/pixel_geometry.h"

namespace chain_tracker {

/// A picture with the truth at the middle of its exposure.
struct SceneFrame {
  cv::Mat3b image;                  ///< BGR
  std::vector<cv::Point2d> points;  ///< material points of the object [px], also when out of view
  std::vector<bool> visible;        ///< per point: in the image and not covered by an occluder
  /// Per segment: image of its frame. A rigid segment's origin is its middle (bottle, box) or its
  /// first joint (robot arm, finger pair) and its x axis points along it; a deformable object has
  /// one segment, the similarity that carries its points of frame 0 best to those of this frame;
  /// its origin is the mean of its points.
  /// Scale 1 is the size in frame 0.
  std::vector<Similarity> segments;
  Similarity image_from_object;  ///< of the object as a whole; scale 1 is the size in frame 0
  cv::Rect2d box;                ///< upright box of the whole object [px], not cut at the image
  bool in_view = true;           ///< whether any of the box is in the image
};

class SyntheticScene {
 public:
  virtual ~SyntheticScene() = default;

  /// Name of the model that tracks this object, or "auto".
  virtual std::string model() const = 0;

  /// Frame `index`, >= 0; beyond options.frames the motion goes on. O(pixels).
  virtual SceneFrame render(int index) const = 0;

  /// The same picture as render(index), noise included, with the object taken away, and with it its
  /// shadow and whatever passes over it.
  virtual cv::Mat3b renderWithoutObject(int index) const = 0;
};

/// Names that makeScene() knows.
std::vector<std::string> sceneNames();

/// Throws std::invalid_argument naming each faulty option, its value and what is allowed.
std::unique_ptr<SyntheticScene> makeScene(const std::string& name, const SceneOptions& options);

}  // namespace chain_tracker
