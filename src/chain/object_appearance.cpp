// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/object_appearance.h"

#include <algorithm>
#include <cmath>

namespace chain_tracker {
namespace {

/// Between the turns for which windows are learned [rad].
constexpr double kTurnStep = 0.1;
/// Samples along a pixel's side: a turned window's pixels are none of the image's.
constexpr int kSamplesPerPixel = 2;

ColorPalette learnPalette(const cv::Mat& image, const Silhouette& silhouette,
                          const AppearanceModel& model) {
  const cv::Mat1b object = maskOf(silhouette, image.size(), 0.0);
  const double size = std::sqrt(static_cast<double>(cv::countNonZero(object)));
  cv::Mat1b ring = maskOf(silhouette, image.size(), std::max(2.0, model.ring * size));
  ring.setTo(0, object);
  return {image, object, ring, {model.palette_colors, model.min_object_share}};
}

}  // namespace

ObjectAppearance::ObjectAppearance(const cv::Mat& image, const ChainLayout& layout,
                                   const AppearanceModel& model)
    : palette_(learnPalette(image, layout.silhouette, model)) {
  palette_.classify(image, cv::Rect(cv::Point(), image.size()), entries_);
  for (const SegmentLayout& segment : layout.segments) {
    for (const PartLayout& part : segment.parts) {
      const cv::Point2d center = segment.image_from_segment.apply(part.position);
      parts_[{windows_.size(), 0}] = learnPart(image, palette_, center, part.side);
      windows_.push_back({center, part.side});
    }
  }
}

const RootHistogram& ObjectAppearance::part(size_t index, double turn) {
  const int steps = static_cast<int>(std::lround(turn / kTurnStep));
  const auto known = parts_.find({index, steps});
  if (known != parts_.end()) return known->second;
  return parts_[{index, steps}] = learnTurned(windows_[index], steps * kTurnStep);
}

RootHistogram ObjectAppearance::learnTurned(const Window& window, double turn) const {
  const int samples = kSamplesPerPixel * std::max(1, static_cast<int>(std::lround(window.side)));
  const double spacing = 1.0 / kSamplesPerPixel;
  const Similarity image_from_window{-turn, 1.0, window.center};
  const cv::Rect image(cv::Point(), entries_.size());
  std::vector<int> counts(static_cast<size_t>(palette_.size()), 0);
  for (int row = 0; row < samples; ++row) {
    for (int column = 0; column < samples; ++column) {
      const cv::Point2d offset(column - 0.5 * (samples - 1), row - 0.5 * (samples - 1));
      const cv::Point pixel = image_from_window.apply(spacing * offset);
      const int entry = image.contains(pixel) ? entries_(pixel) : ColorPalette::kOther;
      ++counts[static_cast<size_t>(entry)];
    }
  }
  RootHistogram histogram;
  for (int count : counts) {
    histogram.push_back(
        std::sqrt(static_cast<float>(count) / static_cast<float>(samples * samples)));
  }
  return histogram;
}

}  // namespace chain_tracker
