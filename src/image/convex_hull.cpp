// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/convex_hull.h"

#include <opencv2/imgproc.hpp>

namespace chain_tracker {

void ConvexHull::replace(std::vector<cv::Point2d>& points) {
  points_.assign(points.begin(), points.end());
  cv::convexHull(points_, hull_);
  points.assign(hull_.begin(), hull_.end());
}

}  // namespace chain_tracker
