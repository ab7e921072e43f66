// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "rigid_object.h"
#include "scene_textures.h"

namespace chain_tracker {
namespace {

/// Of the box's front, in fractions of the image's shorter side.
constexpr double kWidth = 0.32;
constexpr double kHeight = 0.45;
constexpr double kSpritePixels = 2.0;
constexpr int kBorder = 4;

const cv::Scalar kCardboard(60.0, 95.0, 190.0);
const cv::Scalar kCream(190.0, 225.0, 238.0);
const cv::Scalar kNavy(95.0, 45.0, 25.0);

/// A bowl with a spoon on a light disc.
void paintPicture(cv::Mat3b& color, cv::RNG& rng) {
  const int columns = color.cols;
  const int rows = color.rows;
  const cv::Point middle(columns / 2, rows * 58 / 100);
  cv::circle(color, middle, columns * 42 / 100, kCream, cv::FILLED, cv::LINE_AA);
  cv::ellipse(color, middle + cv::Point(0, columns / 12), {columns * 30 / 100, columns * 20 / 100},
              0.0, 0.0, 180.0, {150.0, 120.0, 60.0}, cv::FILLED, cv::LINE_AA);
  const cv::Size rim(columns * 30 / 100, columns * 9 / 100);
  cv::ellipse(color, middle + cv::Point(0, columns / 12), rim, 0.0, 0.0, 360.0,
              {235.0, 240.0, 240.0}, cv::FILLED, cv::LINE_AA);
  for (int flake = 0; flake < 90; ++flake) {
    const double phi = rng.uniform(0.0, 2.0 * CV_PI);
    const double radius = 0.85 * std::sqrt(rng.uniform(0.0, 1.0));
    const cv::Point at(middle.x + cvRound(radius * rim.width * std::cos(phi)),
                       middle.y + columns / 12 + cvRound(radius * rim.height * std::sin(phi)) - 3);
    cv::ellipse(color, at, {columns / 40, columns / 60}, rng.uniform(0.0, 180.0), 0.0, 360.0,
                {rng.uniform(40.0, 90.0), rng.uniform(120.0, 170.0), rng.uniform(190.0, 230.0)},
                cv::FILLED, cv::LINE_AA);
  }
  cv::line(color, middle + cv::Point(columns / 8, columns / 15),
           middle + cv::Point(columns * 2 / 5, -columns / 4), {190.0, 190.0, 185.0}, columns / 30,
           cv::LINE_AA);
}

void paintLettering(cv::Mat3b& color, cv::RNG& rng) {
  const int columns = color.cols;
  const int rows = color.rows;
  cv::rectangle(color, cv::Rect(0, rows / 14, columns, rows / 5), kNavy, cv::FILLED);
  const double size = columns / 190.0;
  cv::putText(color, "GOLDEN", {columns / 14, rows * 155 / 1000}, cv::FONT_HERSHEY_TRIPLEX, size,
              {80.0, 215.0, 250.0}, cvRound(3.0 * size), cv::LINE_AA);
  cv::putText(color, "flakes", {columns * 40 / 100, rows * 235 / 1000},
              cv::FONT_HERSHEY_COMPLEX_SMALL, 1.25 * size, kCream, cvRound(1.5 * size),
              cv::LINE_AA);
  paintPrint({columns / 14, rows * 86 / 100, columns / 2, rows / 10}, std::max(4, rows / 40),
             kCream, rng, color);
  const cv::Rect code(columns * 68 / 100, rows * 85 / 100, columns / 4, rows / 10);
  cv::rectangle(color, code, {235.0, 240.0, 240.0}, cv::FILLED);
  for (int x = code.x + 4; x < code.br().x - 5; x += rng.uniform(3, 7)) {
    cv::rectangle(color, cv::Rect(x, code.y + 3, rng.uniform(1, 4), code.height - 8),
                  {30.0, 25.0, 25.0}, cv::FILLED);
  }
}

/// Worn edges and a sheen across the front.
void paintWear(cv::Mat3b& color, cv::RNG& rng) {
  cv::Mat1b worn(color.size(), uchar(0));
  cv::rectangle(worn, cv::Rect(0, 0, color.cols, color.rows), 150, 3);
  cv::GaussianBlur(worn, worn, {0, 0}, 2.0);
  tint(worn, {215.0, 225.0, 230.0}, color);
  addGrain(3.0, 0.8, rng, color);
  shadeUnevenly(0.35, rng, color);
}

Sprite paintFront(const cv::Size2d& size, bool plain, cv::RNG& rng) {
  const cv::Size pixels(cvRound(size.width * kSpritePixels), cvRound(size.height * kSpritePixels));
  cv::Mat3b color = paintMottle(pixels, kCardboard, 7.0, rng);
  if (!plain) {
    paintPicture(color, rng);
    paintLettering(color, rng);
  }
  paintWear(color, rng);
  cv::Mat1b coverage(pixels, uchar(255));
  cv::copyMakeBorder(color, color, kBorder, kBorder, kBorder, kBorder, cv::BORDER_REPLICATE);
  cv::copyMakeBorder(coverage, coverage, kBorder, kBorder, kBorder, kBorder, cv::BORDER_CONSTANT);
  return {color,
          coverage,
          {kBorder + 0.5 * (pixels.width - 1), kBorder + 0.5 * (pixels.height - 1)},
          kSpritePixels};
}

}  // namespace

/// The front of a cereal box. Its points are its corners: top left, top right, bottom right, bottom
/// left.
SceneObjectPtr makeBox(const SceneOptions& options, cv::RNG& rng) {
  const cv::Size2d size(kWidth * shorterSide(options), kHeight * shorterSide(options));
  const double x = 0.5 * size.width;
  const double y = 0.5 * size.height;
  const std::vector<cv::Point2d> corners{{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  return std::make_unique<RigidObject>(paintFront(size, options.plain, rng), corners, corners,
                                       SceneHabits());
}

}  // namespace chain_tracker
