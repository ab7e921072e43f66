// SPDX-License-Identifier: BSD-3-Clause
/// Runs a plan's trees on whole images in 64 bits: obvious, slow, the twin of the buffered one.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/haar/convolution_plan.h"

namespace chain_tracker::haar {

/// One plane of responses for each feature, of the image's size, under the border convention of
/// haar_feature.h. O(pixels * accesses) time, O(pixels * nodes) memory.
std::vector<cv::Mat1i> runReference(const ConvolutionPlan& plan, const cv::Mat1b& image);

}  // namespace chain_tracker::haar
