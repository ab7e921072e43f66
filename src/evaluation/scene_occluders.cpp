// SPDX-License-Identifier: BSD-3-Clause
#include "scene_occluders.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "scene_textures.h"

namespace chain_tracker {
namespace {

constexpr int kBorder = 4;

/// A checked cloth, a printed sheet or a wooden board; `width` px along x, which is where it goes.
Sprite paintThing(int kind, const cv::Size& size, cv::RNG& rng) {
  cv::Mat3b color;
  if (kind == 0) {
    color = paintMottle(size, {95.0, 90.0, 85.0}, 9.0, rng);
    const int pitch = std::max(6, size.width / 6);
    cv::Mat1b checks(size, uchar(0));
    for (int x = 0; x < size.width; x += pitch)
      checks.colRange(x, std::min(x + pitch / 3, size.width)) += 90;
    for (int y = 0; y < size.height; y += pitch)
      checks.rowRange(y, std::min(y + pitch / 3, size.height)) += 90;
    tint(checks, randomColor(rng), color);
    addGrain(6.0, 0.7, rng, color);
  } else if (kind == 1) {
    color = paintMottle(size, {205.0, 222.0, 228.0}, 4.0, rng);
    const int margin = std::max(2, size.width / 12);
    cv::rectangle(color, cv::Rect(margin, margin, size.width - 2 * margin, size.height / 5),
                  randomColor(rng), cv::FILLED);
    paintPrint({margin, margin + size.height / 4, size.width - 2 * margin,
                size.height * 3 / 4 - 2 * margin},
               std::max(5, size.height / 14), {70.0, 62.0, 60.0}, rng, color);
  } else {
    color = paintWood(size, {60.0, 90.0, 125.0}, 14.0, rng);
  }
  shadeUnevenly(0.4, rng, color);
  cv::Mat1b coverage(size, uchar(255));
  cv::copyMakeBorder(color, color, kBorder, kBorder, kBorder, kBorder, cv::BORDER_REPLICATE);
  cv::copyMakeBorder(coverage, coverage, kBorder, kBorder, kBorder, kBorder, cv::BORDER_CONSTANT);
  return {
      color, coverage, {kBorder + 0.5 * (size.width - 1), kBorder + 0.5 * (size.height - 1)}, 1.0};
}

}  // namespace

Occluders::Occluders(const SceneOptions& options, double object_length, cv::RNG& rng)
    : width_(options.occluder_size * object_length), step_(width_ / options.occlusion_frames) {
  for (int i = 0; i < options.occlusions; ++i) {
    const double heading = rng.uniform(0.0, 2.0 * CV_PI);
    const cv::Size size(std::max(1, cvRound(width_)),
                        std::max(1, cvRound(width_ * rng.uniform(0.9, 1.4))));
    const int kind = (rng.uniform(0, 3) + i) % 3;
    passages_.push_back({paintThing(kind, size, rng),
                         options.frames * (i + 1.0) / (options.occlusions + 1.0),
                         {std::cos(heading), std::sin(heading)}});
  }
}

void Occluders::paint(double frame, const cv::Point2d& middle, double scale, Layer& layer) const {
  for (const Passage& passage : passages_) {
    const double along = step_ * (frame - passage.meeting);
    passage.sprite.paint(
        {directionOf(passage.direction), scale, middle + scale * along * passage.direction}, layer);
  }
}

}  // namespace chain_tracker
