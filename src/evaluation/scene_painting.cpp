// SPDX-License-Identifier: BSD-3-Clause
#include "scene_painting.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace chain_tracker {
namespace {

/// Canvas pixels are painted this much finer and averaged, which is the anti-aliasing.
constexpr int kSupersampling = 3;

cv::Scalar randomColor(cv::RNG& rng) {
  return {rng.uniform(20.0, 235.0), rng.uniform(20.0, 235.0), rng.uniform(20.0, 235.0)};
}

/// Pixels that the sprite may touch under the pose.
cv::Rect coveredRegion(const Sprite& sprite, const Similarity& image_from_object,
                       const cv::Size& image_size) {
  const auto corner = [&](int x, int y) {
    return image_from_object.apply((cv::Point2d(x, y) - sprite.center) / sprite.pixels);
  };
  const cv::Rect2d bounds =
      uprightBounds({corner(0, 0), corner(sprite.color.cols, 0), corner(0, sprite.color.rows),
                     corner(sprite.color.cols, sprite.color.rows)});
  const cv::Rect touched(cv::Point(cvFloor(bounds.x) - 1, cvFloor(bounds.y) - 1),
                         cv::Point(cvCeil(bounds.br().x) + 2, cvCeil(bounds.br().y) + 2));
  return touched & cv::Rect(cv::Point(), image_size);
}

/// Lays a finer picture with coverage over part of a canvas.
void blend(const cv::Mat& fine_color, const cv::Mat& fine_coverage, cv::Mat canvas) {
  cv::Mat weight;
  cv::cvtColor(fine_coverage, weight, cv::COLOR_GRAY2BGR);
  cv::Mat below;
  cv::resize(canvas, below, fine_color.size(), 0.0, 0.0, cv::INTER_NEAREST);
  cv::Mat above;
  cv::multiply(fine_color, weight, above, 1.0 / 255.0);
  cv::multiply(below, cv::Scalar::all(255) - weight, below, 1.0 / 255.0);
  cv::resize(above + below, canvas, canvas.size(), 0.0, 0.0, cv::INTER_AREA);
}

}  // namespace

cv::Mat3b paintNoise(const cv::Size& size, const cv::Scalar& mean, double contrast, cv::RNG& rng) {
  cv::Mat3f sum(size, cv::Vec3f(static_cast<float>(mean[0]), static_cast<float>(mean[1]),
                                static_cast<float>(mean[2])));
  for (int octave = 0; octave < 4; ++octave) {
    const int cells = 4 << octave;
    cv::Mat3f coarse(std::max(2, cells * size.height / std::max(size.width, 1)), cells);
    rng.fill(coarse, cv::RNG::NORMAL, 0.0, contrast / (octave + 1.0));
    cv::Mat3f fine;
    cv::resize(coarse, fine, size, 0.0, 0.0, cv::INTER_CUBIC);
    sum += fine;
  }
  cv::Mat3b image;
  sum.convertTo(image, CV_8UC3);
  return image;
}

cv::Mat3b paintBackground(const cv::Size& size, cv::RNG& rng) {
  cv::Mat3b wall = paintNoise(size, {150.0, 160.0, 165.0}, 14.0, rng);
  for (int i = 0; i < 14; ++i) {
    const cv::RotatedRect blob(
        cv::Point2f(rng.uniform(0.0F, 1.0F) * static_cast<float>(size.width),
                    rng.uniform(0.0F, 1.0F) * static_cast<float>(size.height)),
        cv::Size2f(rng.uniform(20.0F, 130.0F), rng.uniform(20.0F, 90.0F)),
        rng.uniform(0.0F, 180.0F));
    cv::Mat3b painted = wall.clone();
    cv::ellipse(painted, blob, randomColor(rng), cv::FILLED, cv::LINE_AA);
    cv::addWeighted(painted, 0.7, wall, 0.3, 0.0, wall);
  }
  return wall;
}

void paintSprite(const Sprite& sprite, const Similarity& image_from_object, cv::Mat3b& canvas) {
  const cv::Rect region = coveredRegion(sprite, image_from_object, canvas.size());
  if (region.empty()) return;
  const cv::Size fine_size = region.size() * kSupersampling;
  const double scale = image_from_object.scale / sprite.pixels * kSupersampling;
  const double c = scale * std::cos(image_from_object.angle);
  const double s = scale * std::sin(image_from_object.angle);
  // Pixel centres of the fine canvas: x_fine = k x + (k - 1) / 2.
  const double half = 0.5 * (kSupersampling - 1);
  const cv::Point2d origin =
      (image_from_object.translation - cv::Point2d(region.tl())) * kSupersampling +
      cv::Point2d(half, half);
  const cv::Matx23d fine_from_sprite(c, -s, origin.x - c * sprite.center.x + s * sprite.center.y, s,
                                     c, origin.y - s * sprite.center.x - c * sprite.center.y);
  cv::Mat color;
  cv::Mat coverage;
  cv::warpAffine(sprite.color, color, fine_from_sprite, fine_size, cv::INTER_LINEAR,
                 cv::BORDER_REPLICATE);
  cv::warpAffine(sprite.coverage, coverage, fine_from_sprite, fine_size, cv::INTER_LINEAR);
  blend(color, coverage, canvas(region));
}

void addNoise(cv::Mat3b& image, double sigma, cv::RNG& rng) {
  if (sigma <= 0.0) return;
  cv::Mat noise(image.size(), CV_16SC3);
  rng.fill(noise, cv::RNG::NORMAL, 0.0, sigma);
  cv::Mat sum;
  cv::add(image, noise, sum, cv::noArray(), CV_16SC3);
  sum.convertTo(image, CV_8UC3);
}

SmoothMotion::SmoothMotion(double cycles, cv::RNG& rng) : cycles_(cycles) {
  for (double& phase : phases_) phase = rng.uniform(0.0, 2.0 * CV_PI);
}

double SmoothMotion::at(double time) const {
  const double t = 2.0 * CV_PI * cycles_ * time;
  return 0.6 * std::sin(t + phases_[0]) + 0.3 * std::sin(1.7 * t + phases_[1]) +
         0.1 * std::sin(2.9 * t + phases_[2]);
}

}  // namespace chain_tracker
