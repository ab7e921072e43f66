// SPDX-License-Identifier: BSD-3-Clause
/// What scenes are painted with: textures, smooth random motion, anti-aliased sprites.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/image/pixel_geometry.h"

namespace chain_tracker {

/// Smooth noise of several octaves around `mean`, `contrast` grey levels strong.
cv::Mat3b paintNoise(const cv::Size& size, const cv::Scalar& mean, double contrast, cv::RNG& rng);

/// A wall with stains, boards and blobs of many colours.
cv::Mat3b paintBackground(const cv::Size& size, cv::RNG& rng);

/// A picture of an object with its coverage, in the object's frame.
struct Sprite {
  cv::Mat3b color;
  cv::Mat1b coverage;   ///< 0 outside the object, 255 on it
  cv::Point2d center;   ///< the object's origin in the sprite [px]
  double pixels = 1.0;  ///< sprite pixels to an object pixel
};

/// Lays the sprite over the canvas under the pose, anti-aliased.
void paintSprite(const Sprite& sprite, const Similarity& image_from_object, cv::Mat3b& canvas);

void addNoise(cv::Mat3b& image, double sigma, cv::RNG& rng);

/// A sum of three sines of random phase: smooth, bounded by 1, never twice the same.
class SmoothMotion {
 public:
  /// `cycles`: slowest sine's number of periods over one unit of time.
  SmoothMotion(double cycles, cv::RNG& rng);
  double at(double time) const;

 private:
  double cycles_;
  double phases_[3];
};

}  // namespace chain_tracker
