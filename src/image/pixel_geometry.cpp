// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/pixel_geometry.h"

#include <algorithm>
#include <cmath>

namespace chain_tracker {

double wrapAngle(double angle) {
  const double wrapped = std::remainder(angle, 2.0 * CV_PI);
  return wrapped <= -CV_PI ? CV_PI : wrapped;
}

double directionOf(const cv::Point2d& vector) {
  // Adding zero turns a negative zero, which atan2 tells from a positive one, into a positive one.
  return std::atan2(vector.y + 0.0, vector.x + 0.0);
}

cv::Point2d Similarity::apply(const cv::Point2d& point) const {
  const double c = scale * std::cos(angle);
  const double s = scale * std::sin(angle);
  return {c * point.x - s * point.y + translation.x, s * point.x + c * point.y + translation.y};
}

cv::Point2d Similarity::applyInverse(const cv::Point2d& point) const {
  const cv::Point2d offset = point - translation;
  const double c = std::cos(angle) / scale;
  const double s = std::sin(angle) / scale;
  return {c * offset.x + s * offset.y, -s * offset.x + c * offset.y};
}

cv::Rect2d uprightBounds(const std::vector<cv::Point2d>& points) {
  CV_Assert(!points.empty());
  cv::Point2d low = points.front();
  cv::Point2d high = points.front();
  for (const cv::Point2d& point : points) {
    low = {std::min(low.x, point.x), std::min(low.y, point.y)};
    high = {std::max(high.x, point.x), std::max(high.y, point.y)};
  }
  return {low, high};
}

double lengthOf(const std::vector<cv::Point2d>& polyline) {
  double length = 0.0;
  for (size_t i = 1; i < polyline.size(); ++i) length += cv::norm(polyline[i] - polyline[i - 1]);
  return length;
}

}  // namespace chain_tracker
