// SPDX-License-Identifier: BSD-3-Clause
/// What a camera does to a scene.
#pragma once

#include <opencv2/core.hpp>

#include "scene_motion.h"

namespace chain_tracker {

/// Normal noise of the standard deviation `sigma` [grey levels], each channel for itself.
void addNoise(cv::Mat3b& image, double sigma, cv::RNG& rng);
/// The same in all three channels: the noise of a mono camera.
void addGreyNoise(cv::Mat3b& image, double sigma, cv::RNG& rng);

/// All three channels become the grey value.
void makeGrey(cv::Mat3b& image);

/// A slow change of the light's strength and, half as much, of its colour.
class IlluminationDrift {
 public:
  /// `strength`: the largest relative change of the light.
  IlluminationDrift(double strength, cv::RNG& rng);
  void apply(double time, cv::Mat3b& image) const;

 private:
  double strength_;
  SmoothMotion light_;
  SmoothMotion warmth_;
};

/// Mean of pictures added one by one.
class Exposure {
 public:
  explicit Exposure(const cv::Size& size) : sum_(size, cv::Vec3f::all(0.0F)) {}
  void add(const cv::Mat3b& image);
  cv::Mat3b mean() const;

 private:
  cv::Mat3f sum_;
  int count_ = 0;
};

}  // namespace chain_tracker
