// SPDX-License-Identifier: BSD-3-Clause
/// How wide the links of a polyline are, as the first image shows them: users draw an axis, and
/// whether it is that of a forearm or of a fly's thorax decides which windows hold it.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_model.h"

namespace chain_tracker {

/// For every edge of the polyline, the width over length, in [0.14, 0.5], of a link that most of
/// the object covers: of the strip that has the colours of the axis, which are those that are rarer
/// farther away. Every link is drawn towards the median of all sides of all links, so that
/// something of the same colours on one side of one of them does little harm. Empty if that median
/// is 0 or beyond what is looked at: the axis does not differ from what lies around it. `image`:
/// CV_8UC3 or CV_8UC1. `polyline`: at least 2 points, finite, no two in a row the same. O(pixels of
/// the image).
std::vector<double> measureAspects(const cv::Mat& image, const std::vector<cv::Point2d>& polyline);

/// The model, with the aspects of those segments that ask for it measured. A model that has not one
/// segment for each edge of the polyline, or whose aspects cannot be measured, stays as it is.
ChainModel withMeasuredAspects(ChainModel model, const cv::Mat& image,
                               const std::vector<cv::Point2d>& polyline);

}  // namespace chain_tracker
