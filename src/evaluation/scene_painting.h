// SPDX-License-Identifier: BSD-3-Clause
/// How scenes are put together: transparent layers, anti-aliased sprites, shadows.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/image/pixel_geometry.h"

namespace chain_tracker {

/// A transparent picture: colours already multiplied by their coverage, in BGRA, so that layers and
/// filtered sprites blend without fringes.
class Layer {
 public:
  explicit Layer(const cv::Size& size) : pixels_(size, cv::Vec4b::all(0)) {}

  /// Lays a piece over what is there; parts outside the layer are cut off.
  void paint(const cv::Mat4b& piece, const cv::Point& top_left);
  /// Lays the layer over an opaque picture of the same size.
  void composite(cv::Mat3b& canvas) const;
  /// Darkens the picture under the layer and a little below and to the right of it, softly; by
  /// `strength` in [0, 1] at the darkest.
  void castShadow(double strength, cv::Mat3b& canvas) const;

  cv::Rect bounds() const { return {cv::Point(), pixels_.size()}; }
  /// Coverage in [0, 255]; 0 outside the layer.
  int coverageAt(const cv::Point2d& point) const;

 private:
  cv::Mat4b pixels_;
  cv::Rect touched_;
};

/// A pixel of a layer: the colour under a coverage in [0, 1].
cv::Vec4b coveredPixel(const cv::Vec3d& color, double coverage);

/// The pixels whose centres lie within the bounds grown by `margin`, cut at the layer.
cv::Rect pixelsWithin(const cv::Rect2d& bounds, double margin, const Layer& layer);

/// Where pixels lie in an object's frame; much faster than a transform for each.
class ObjectGrid {
 public:
  ObjectGrid(const Similarity& image_from_object, const cv::Point& first_pixel);
  /// `x`, `y`: pixels from the first one.
  cv::Point2d at(int x, int y) const { return origin_ + x * right_ + y * down_; }

 private:
  cv::Point2d origin_;
  cv::Point2d right_;
  cv::Point2d down_;
};

/// A picture of an object with its coverage, in the object's frame.
class Sprite {
 public:
  Sprite() = default;
  /// `coverage`: 0 outside the object, 255 on it. `center`: the object's origin in the picture
  /// [px]. `pixels`: picture pixels to an object pixel.
  Sprite(const cv::Mat3b& color, const cv::Mat1b& coverage, const cv::Point2d& center,
         double pixels);

  void paint(const Similarity& image_from_object, Layer& layer) const;
  /// A rectangle cut out of it near its middle, `size` of its own size.
  Sprite piece(double size, cv::RNG& rng) const;

 private:
  Sprite(const cv::Mat4b& covered, const cv::Point2d& center, double pixels);

  std::vector<cv::Mat4b> levels_;  ///< each half as large as the one before
  cv::Point2d center_;
  double pixels_ = 1.0;
};

}  // namespace chain_tracker
