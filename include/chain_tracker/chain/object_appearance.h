// SPDX-License-Identifier: BSD-3-Clause
/// What the object looks like: learned in the first frame, never updated, so that it cannot drift
/// onto the background (thesis ch. 3.2.1).
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/chain_model.h"
#include "chain_tracker/chain/part_costs.h"
#include "chain_tracker/image/color_palette.h"

namespace chain_tracker {

struct ObjectAppearance {
  ColorPalette palette;
  std::vector<RootHistogram> parts;  ///< of the segments' parts in order
};

/// Colours of the object against the ring around it, and each part's histogram.
ObjectAppearance learnAppearance(const cv::Mat& image, const ChainLayout& layout,
                                 const AppearanceModel& model);

}  // namespace chain_tracker
