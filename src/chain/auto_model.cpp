// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/auto_model.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/target_checks.h"
#include "chain_tracker/image/pixel_geometry.h"

namespace chain_tracker {
namespace {

constexpr double kRightAngleTolerance = 15.0 * CV_PI / 180.0;
constexpr double kSharpTurn = 45.0 * CV_PI / 180.0;
constexpr std::size_t kFewPoints = 5;
/// Of deformable segments.
constexpr double kNarrowestWindow = 6.0;  // [px]
constexpr int kFewestParts = 6;
/// Of grids.
constexpr int kFewestCells = 4;

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

/// Takes a part from every grid whose parts are too small; returns whether there was one.
bool takeCrowdedParts(ChainModel& model, const std::vector<cv::Point2d>& points) {
  const ChainLayout layout = layOut(model, points);
  bool was_crowded = false;
  for (std::size_t m = 0; m < model.segments.size(); ++m) {
    SegmentModel& segment = model.segments[m];
    if (!isGrid(segment.layout) || segment.parts <= kFewestCells) continue;
    if (layout.segments[m].parts.front().side >= kSmallestSide) continue;
    --segment.parts;
    was_crowded = true;
  }
  return was_crowded;
}

}  // namespace

std::string autoModelName(const std::vector<cv::Point2d>& points) {
  if (isRectangle(points)) return "box";
  if (points.size() == 2) return "bottle";
  return points.size() <= kFewPoints || isSharpEverywhere(points) ? "articulated" : "cable";
}

ChainModel withRoomForParts(const ChainModel& model, const std::vector<cv::Point2d>& points) {
  ChainModel roomy = forPolyline(model, points.size());
  layOut(roomy, points);  // refuses points that are not those of the model
  for (std::size_t m = 0; m < roomy.segments.size(); ++m) {
    SegmentModel& segment = roomy.segments[m];
    if (segment.layout != Layout::kDeformable) continue;
    const double length =
        roomy.segments.size() > 1 ? cv::norm(points[m + 1] - points[m]) : lengthOf(points);
    const double room = std::max<double>(kFewestParts, length * segment.window / kNarrowestWindow);
    if (room < segment.parts) segment.parts = static_cast<int>(room);
  }
  while (takeCrowdedParts(roomy, points)) {
  }
  return roomy;
}

}  // namespace chain_tracker
