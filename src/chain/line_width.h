// SPDX-License-Identifier: BSD-3-Clause
/// How thick a line is, as the first image shows it: users draw along the middle of a fish as along
/// that of a thread. Windows that lie well within an object look the same wherever it is.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_model.h"

namespace chain_tracker {

/// Median thickness [px] of what the polyline was drawn along, as far as the colours reach that it
/// lies on and that are rarer farther away; 0 if it does not stand out, or is thicker than a
/// quarter of its length. `image`: CV_8UC3 or CV_8UC1. `polyline`: at least 2 points, finite, no
/// two in a row the same. O(pixels of the image).
double measureThickness(const cv::Mat& image, const std::vector<cv::Point2d>& polyline);

/// The model; each deformable segment that asks for it has fewer and wider windows if what it lies
/// on is thicker than they are: of 0.65 of the thickness, two to a side. A joined model that has
/// not one segment for each edge of the polyline stays as it is.
ChainModel withMeasuredWindows(ChainModel model, const cv::Mat& image,
                               const std::vector<cv::Point2d>& polyline);

}  // namespace chain_tracker
