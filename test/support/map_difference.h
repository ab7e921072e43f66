// SPDX-License-Identifier: BSD-3-Clause
/// Comparisons of maps that say where they differ first.
#pragma once

#include <string>

#include <opencv2/core.hpp>

namespace chain_tracker {

/// Empty if both maps, of one channel, have one size and every pair of values is equal or differs
/// by at most `tolerance`; otherwise the first place, in row-major order, where that is not so. Two
/// infinities of one sign are equal, NaN equals nothing.
std::string firstDifference(const cv::Mat& expected, const cv::Mat& actual, double tolerance = 0.0);

}  // namespace chain_tracker
