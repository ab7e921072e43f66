// SPDX-License-Identifier: BSD-3-Clause
/// Convex hulls of points between pixels, in memory that is kept.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace chain_tracker {

class ConvexHull {
 public:
  /// Replaces points by the corners of their convex hull. O(points x log points).
  void replace(std::vector<cv::Point2d>& points);

 private:
  std::vector<cv::Point2f> points_;
  std::vector<cv::Point2f> hull_;
};

}  // namespace chain_tracker
