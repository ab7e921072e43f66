// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/auto_model.h"

#include <cmath>
#include <cstddef>

namespace chain_tracker {
namespace {

bool isRectangle(const std::vector<cv::Point2d>& points) {
  if (points.size() != 4) return false;
  const double largest_cosine = std::sin(15.0 * CV_PI / 180.0);
  for (std::size_t i = 0; i < 4; ++i) {
    const cv::Point2d before = points[i] - points[(i + 3) % 4];
    const cv::Point2d after = points[(i + 1) % 4] - points[i];
    const double lengths = cv::norm(before) * cv::norm(after);
    if (!(std::abs(before.dot(after)) <= largest_cosine * lengths)) return false;
  }
  return true;
}

}  // namespace

std::string autoModelName(const std::vector<cv::Point2d>& points) {
  if (isRectangle(points)) return "box";
  return points.size() == 2 ? "bottle" : "cable";
}

}  // namespace chain_tracker
