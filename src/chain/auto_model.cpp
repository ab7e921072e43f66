// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/auto_model.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "chain_tracker/image/pixel_geometry.h"

namespace chain_tracker {
namespace {

constexpr double kRightAngleTolerance = 15.0 * CV_PI / 180.0;
constexpr double kSharpTurn = 45.0 * CV_PI / 180.0;
constexpr std::size_t kFewPoints = 5;
/// Of a deformable object.
constexpr double kNarrowestWindow = 6.0;
constexpr int kFewestParts = 6;

bool isRectangle(const std::vector<cv::Point2d>& points) {
  if (points.size() != 4) return false;
  const double largest_cosine = std::sin(kRightAngleTolerance);
  for (std::size_t i = 0; i < 4; ++i) {
    const cv::Point2d before = points[i] - points[(i + 3) % 4];
    const cv::Point2d after = points[(i + 1) % 4] - points[i];
    const double lengths = cv::norm(before) * cv::norm(after);
    if (!(std::abs(before.dot(after)) <= largest_cosine * lengths)) return false;
  }
  return true;
}

bool isSharpEverywhere(const std::vector<cv::Point2d>& points) {
  for (std::size_t i = 2; i < points.size(); ++i) {
    const double before = directionOf(points[i - 1] - points[i - 2]);
    const double after = directionOf(points[i] - points[i - 1]);
    if (std::abs(wrapAngle(after - before)) <= kSharpTurn) return false;
  }
  return true;
}

}  // namespace

std::string autoModelName(const std::vector<cv::Point2d>& points) {
  if (isRectangle(points)) return "box";
  if (points.size() == 2) return "bottle";
  return points.size() <= kFewPoints || isSharpEverywhere(points) ? "articulated" : "cable";
}

ChainModel withRoomForParts(ChainModel model, const std::vector<cv::Point2d>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += cv::norm(points[i] - points[i - 1]);
  for (SegmentModel& segment : model.segments) {
    if (segment.layout != Layout::kDeformable) continue;
    const double room = std::max<double>(kFewestParts, length * segment.window / kNarrowestWindow);
    if (room < segment.parts) segment.parts = static_cast<int>(room);
  }
  return model;
}

}  // namespace chain_tracker
