// SPDX-License-Identifier: BSD-3-Clause
#include "bottle_scene.h"

#include <cmath>

#include <opencv2/imgproc.hpp>

namespace chain_tracker {
namespace {

/// Of the bottle, in fractions of the image's shorter side.
constexpr double kLength = 0.45;
constexpr double kAspect = 0.36;
/// The sprite is painted finer than it will be seen.
constexpr double kSpritePixels = 2.0;

double lengthIn(const cv::Size& image) { return kLength * std::min(image.width, image.height); }

/// Light from one side: a bright streak off the middle, darker towards the rims.
void shade(cv::Mat3b& color) {
  for (int row = 0; row < color.rows; ++row) {
    const double across = 2.0 * (row + 0.5) / color.rows - 1.0;
    const double light = 1.1 * std::sqrt(1.0 - 0.75 * across * across) +
                         0.35 * std::exp(-std::pow((across + 0.4) / 0.12, 2.0));
    color.row(row) *= light;
  }
}

void stamp(cv::Mat3b& color, const cv::Rect& area, const cv::Scalar& mean, double contrast,
           cv::RNG& rng) {
  paintNoise(area.size(), mean, contrast, rng).copyTo(color(area));
}

/// Lies along +x: the cap at the left end, a label with bars in the middle of the body.
Sprite paintBottle(double length, cv::RNG& rng) {
  const int columns = cvRound(length * kSpritePixels);
  const int rows = cvRound(length * kAspect * kSpritePixels);
  const int border = 4;
  cv::Mat3b color(rows, columns);
  stamp(color, {0, 0, columns, rows}, {70.0, 110.0, 45.0}, 16.0, rng);
  stamp(color, {0, 0, columns / 7, rows}, {40.0, 45.0, 190.0}, 14.0, rng);
  const cv::Rect label(columns * 2 / 5, 0, columns * 2 / 5, rows);
  stamp(color, label, {200.0, 225.0, 235.0}, 10.0, rng);
  for (int bar = 0; bar < 5; ++bar) {
    const int x = label.x + label.width * (2 * bar + 1) / 11;
    cv::rectangle(color,
                  cv::Rect(x, rows / 5, label.width / 14, rows / 4 + rng.uniform(0, rows / 3)),
                  {90.0, 40.0, 25.0}, cv::FILLED);
  }
  shade(color);
  cv::Mat1b coverage(rows, columns, uchar(0));
  const int shoulder = rows / 8;
  cv::rectangle(coverage, {columns / 7, 0, columns - columns / 7, rows}, 255, cv::FILLED);
  cv::rectangle(coverage, {0, shoulder, columns / 5, rows - 2 * shoulder}, 255, cv::FILLED);

  Sprite sprite;
  cv::copyMakeBorder(color, sprite.color, border, border, border, border, cv::BORDER_REPLICATE);
  cv::copyMakeBorder(coverage, sprite.coverage, border, border, border, border,
                     cv::BORDER_CONSTANT);
  sprite.center = {border + 0.5 * (columns - 1), border + 0.5 * (rows - 1)};
  sprite.pixels = kSpritePixels;
  return sprite;
}

}  // namespace

BottleScene::BottleScene(const SceneOptions& options)
    : options_(options),
      rng_(options.seed),
      background_(paintBackground(options.size, rng_)),
      bottle_(paintBottle(lengthIn(options.size), rng_)),
      x_(1.5, rng_),
      y_(1.2, rng_),
      turn_(2.0, rng_),
      growth_(1.0, rng_) {}

Similarity BottleScene::poseAt(int index) const {
  // 300 frames are one unit of time: a longer clip moves on, not slower.
  const double time = index / 300.0;
  const double reach = 0.22;
  return {CV_PI / 2.0 + 0.8 * turn_.at(time),
          std::exp(0.3 * growth_.at(time)),
          {options_.size.width * (0.5 + reach * x_.at(time)),
           options_.size.height * (0.5 + reach * y_.at(time))}};
}

SceneFrame BottleScene::render(int index) const {
  SceneFrame frame;
  frame.image_from_object = poseAt(index);
  background_.copyTo(frame.image);
  paintSprite(bottle_, frame.image_from_object, frame.image);
  cv::RNG noise(options_.seed * 7919U + static_cast<std::uint32_t>(index) + 1U);
  addNoise(frame.image, options_.noise, noise);
  const double half = 0.5 * lengthIn(options_.size);
  frame.points = {frame.image_from_object.apply({-half, 0.0}),
                  frame.image_from_object.apply({half, 0.0})};
  return frame;
}

}  // namespace chain_tracker
