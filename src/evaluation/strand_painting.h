// SPDX-License-Identifier: BSD-3-Clause
/// Long bent things with a texture along them: cables, threads, strings, fingers.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "scene_painting.h"

namespace chain_tracker {

struct StrandLook {
  cv::Mat3b strip;                  ///< columns go along the strand, rows across it
  std::vector<double> half_widths;  ///< in equal steps along the strand, at scale 1 [px]; >= 1
};

/// Paints the strand around its middle line, whose points [px] lie in equal steps along the strand;
/// >= 2, `scale` times as wide as its look says. The ends are cut straight.
void paintStrand(const std::vector<cv::Point2d>& line, const StrandLook& look, double scale,
                 Layer& layer);

/// The upright box of what paintStrand() covers.
cv::Rect2d strandBounds(const std::vector<cv::Point2d>& line, const StrandLook& look, double scale);

/// `count` points in equal steps from the first to the last of a line, interpolated.
std::vector<cv::Point2d> resampleLine(const std::vector<cv::Point2d>& line, int count);

/// Light on a round thing: bright off the middle, dark at the rims; `gloss` of the highlight.
void shadeAcross(cv::Mat3b& strip, double gloss);

}  // namespace chain_tracker
