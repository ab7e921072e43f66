// SPDX-License-Identifier: BSD-3-Clause
#include "camera_effects.h"

#include <algorithm>
#include <array>

#include <opencv2/imgproc.hpp>

namespace chain_tracker {

void addNoise(cv::Mat3b& image, double sigma, cv::RNG& rng) {
  if (sigma <= 0.0) return;
  cv::Mat noise(image.size(), CV_16SC3);
  rng.fill(noise, cv::RNG::NORMAL, 0.0, sigma);
  cv::Mat sum;
  cv::add(image, noise, sum, cv::noArray(), CV_16SC3);
  sum.convertTo(image, CV_8UC3);
}

void addGreyNoise(cv::Mat3b& image, double sigma, cv::RNG& rng) {
  if (sigma <= 0.0) return;
  cv::Mat noise(image.size(), CV_16SC1);
  rng.fill(noise, cv::RNG::NORMAL, 0.0, sigma);
  cv::Mat noise_bgr;
  cv::merge(std::array<cv::Mat, 3>{noise, noise, noise}, noise_bgr);
  cv::Mat sum;
  cv::add(image, noise_bgr, sum, cv::noArray(), CV_16SC3);
  sum.convertTo(image, CV_8UC3);
}

void makeGrey(cv::Mat3b& image) {
  cv::Mat1b grey;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  cv::cvtColor(grey, image, cv::COLOR_GRAY2BGR);
}

IlluminationDrift::IlluminationDrift(double strength, cv::RNG& rng)
    : strength_(strength), light_(1.5, rng), warmth_(1.0, rng) {}

void IlluminationDrift::apply(double time, cv::Mat3b& image) const {
  if (strength_ <= 0.0) return;
  const double light = 1.0 + strength_ * light_.at(time);
  const double warmth = 0.5 * strength_ * warmth_.at(time);
  cv::multiply(image, cv::Scalar(light * (1.0 - warmth), light, light * (1.0 + warmth)), image);
}

void Exposure::add(const cv::Mat3b& image) {
  cv::accumulate(image, sum_);
  ++count_;
}

cv::Mat3b Exposure::mean() const {
  cv::Mat3b image;
  sum_.convertTo(image, CV_8UC3, 1.0 / std::max(count_, 1));
  return image;
}

}  // namespace chain_tracker
