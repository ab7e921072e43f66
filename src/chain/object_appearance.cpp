// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/object_appearance.h"

#include <algorithm>
#include <cmath>

namespace chain_tracker {
namespace {

ColorPalette learnPalette(const cv::Mat& image, const Silhouette& silhouette,
                          const AppearanceModel& model) {
  const cv::Mat1b object = maskOf(silhouette, image.size(), 0.0);
  const double size = std::sqrt(static_cast<double>(cv::countNonZero(object)));
  cv::Mat1b ring = maskOf(silhouette, image.size(), std::max(2.0, model.ring * size));
  ring.setTo(0, object);
  return {image, object, ring, {model.palette_colors, model.min_object_share}};
}

}  // namespace

ObjectAppearance learnAppearance(const cv::Mat& image, const ChainLayout& layout,
                                 const AppearanceModel& model) {
  ObjectAppearance appearance{learnPalette(image, layout.silhouette, model), {}};
  for (const SegmentLayout& segment : layout.segments) {
    for (const PartLayout& part : segment.parts) {
      appearance.parts.push_back(learnPart(
          image, appearance.palette, segment.image_from_segment.apply(part.position), part.side));
    }
  }
  return appearance;
}

}  // namespace chain_tracker
