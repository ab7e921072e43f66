// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "rigid_object.h"
#include "scene_textures.h"

namespace chain_tracker {
namespace {

/// Of the bottle, in fractions of the image's shorter side.
constexpr double kLength = 0.45;
constexpr double kAspect = 0.36;
/// The sprite is painted finer than it will be seen.
constexpr double kSpritePixels = 2.0;
constexpr int kBorder = 4;

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

void paintCapAndLabel(cv::Mat3b& color, cv::RNG& rng) {
  const int columns = color.cols;
  const int rows = color.rows;
  stamp(color, {0, 0, columns / 7, rows}, {40.0, 45.0, 190.0}, 14.0, rng);
  const cv::Rect label(columns * 2 / 5, 0, columns * 2 / 5, rows);
  stamp(color, label, {200.0, 225.0, 235.0}, 10.0, rng);
  for (int bar = 0; bar < 5; ++bar) {
    const int x = label.x + label.width * (2 * bar + 1) / 11;
    cv::rectangle(color,
                  cv::Rect(x, rows / 5, label.width / 14, rows / 4 + rng.uniform(0, rows / 3)),
                  {90.0, 40.0, 25.0}, cv::FILLED);
  }
}

/// Lies along +x: the cap at the left end, a label with bars in the middle of the body.
Sprite paintBottle(double length, bool plain, cv::RNG& rng) {
  const int columns = cvRound(length * kSpritePixels);
  const int rows = cvRound(length * kAspect * kSpritePixels);
  cv::Mat3b color(rows, columns);
  stamp(color, {0, 0, columns, rows}, {70.0, 110.0, 45.0}, 16.0, rng);
  if (!plain) paintCapAndLabel(color, rng);
  shade(color);
  cv::Mat1b coverage(rows, columns, uchar(0));
  const int shoulder = rows / 8;
  cv::rectangle(coverage, {columns / 7, 0, columns - columns / 7, rows}, 255, cv::FILLED);
  cv::rectangle(coverage, {0, shoulder, columns / 5, rows - 2 * shoulder}, 255, cv::FILLED);
  cv::copyMakeBorder(color, color, kBorder, kBorder, kBorder, kBorder, cv::BORDER_REPLICATE);
  cv::copyMakeBorder(coverage, coverage, kBorder, kBorder, kBorder, kBorder, cv::BORDER_CONSTANT);
  return {
      color, coverage, {kBorder + 0.5 * (columns - 1), kBorder + 0.5 * (rows - 1)}, kSpritePixels};
}

}  // namespace

/// A bottle with cap and label that shifts, turns to and fro and changes its size. Its points are
/// its two ends, cap first.
SceneObjectPtr makeBottle(const SceneOptions& options, cv::RNG& rng) {
  const double length = kLength * shorterSide(options);
  const double half = 0.5 * length;
  const double side = kAspect * half;
  const double neck = side * 0.75;
  const double shoulder = half * (2.0 / 7.0 - 1.0);
  SceneHabits habits;
  habits.motion.angle = CV_PI / 2.0;
  habits.clutter = 0;
  habits.shadow = 0.0;
  return std::make_unique<RigidObject>(paintBottle(length, options.plain, rng),
                                       std::vector<cv::Point2d>{{-half, 0.0}, {half, 0.0}},
                                       std::vector<cv::Point2d>{{-half, -neck},
                                                                {-half, neck},
                                                                {shoulder, -side},
                                                                {shoulder, side},
                                                                {half, -side},
                                                                {half, side}},
                                       habits);
}

}  // namespace chain_tracker
