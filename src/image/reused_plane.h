// SPDX-License-Identifier: BSD-3-Clause
/// Planes that are filled anew with every call, in memory that is kept.
#pragma once

#include <algorithm>

#include <opencv2/core.hpp>

namespace chain_tracker {

/// Memory grows to multiples of this [elements], so that it soon stays as it is.
constexpr int kPlaneCapacityStep = 32;

/// Gives the plane a size; what it holds means nothing afterwards. Allocates only where it never
/// was as wide or as high before. The plane may be a part of a larger one: its rows need not follow
/// one another in memory.
template <typename Element>
void reuse(cv::Mat_<Element>& plane, const cv::Size& size) {
  cv::Size capacity;
  cv::Point offset;
  if (!plane.empty()) plane.locateROI(capacity, offset);
  if (size.width > capacity.width || size.height > capacity.height) {
    const auto grown = [](int wanted, int had) {
      return (std::max(wanted, had) + kPlaneCapacityStep - 1) / kPlaneCapacityStep *
             kPlaneCapacityStep;
    };
    plane.create(grown(size.height, capacity.height), grown(size.width, capacity.width));
  }
  plane.adjustROI(0, size.height - plane.rows, 0, size.width - plane.cols);
}

/// Sets all elements; cv::Mat::setTo() allocates memory for a run of them first.
template <typename Element>
void fill(cv::Mat_<Element>& plane, Element value) {
  for (int row = 0; row < plane.rows; ++row) std::fill_n(plane[row], plane.cols, value);
}

}  // namespace chain_tracker
