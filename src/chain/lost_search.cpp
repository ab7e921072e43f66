// SPDX-License-Identifier: BSD-3-Clause
#include "lost_search.h"

#include <algorithm>
#include <cmath>

namespace chain_tracker {
namespace {

/// Between the orientations that are tried, at least [rad].
constexpr double kLeastSweep = 0.4;

/// Orientations that see all between them.
int sweepTurns(const SegmentModel& model) {
  const double seen = std::max(kLeastSweep, model.orientation_hypotheses * model.orientation_step);
  return std::max(2, static_cast<int>(std::ceil(2.0 * CV_PI / seen)));
}

}  // namespace

double sweepStep(const SegmentModel& model) { return 2.0 * CV_PI / sweepTurns(model); }

double soughtTurn(const SegmentModel& model, int failures) {
  if (failures == 0 || failures % 2 == 1) return 0.0;
  const int i = 1 + (failures / 2 - 1) % (sweepTurns(model) - 1);
  const int steps = (i % 2 == 0 ? -1 : 1) * ((i + 1) / 2);
  return steps * sweepStep(model);
}

void turnAboutMiddle(double turn, ChainState& state) {
  if (turn == 0.0) return;
  cv::Point2d middle;
  for (const PartState& part : state.parts) {
    middle += part.position / static_cast<double>(state.parts.size());
  }
  const Similarity rotation{turn, 1.0, {}};
  const auto turned = [&](const cv::Point2d& point) {
    return middle + rotation.apply(point - middle);
  };
  for (PartState& part : state.parts) {
    part.position = turned(part.position);
    part.orientation = wrapAngle(part.orientation + turn);
  }
  for (SegmentState& segment : state.segments) {
    Similarity& pose = segment.image_from_segment;
    pose = {wrapAngle(pose.angle + turn), pose.scale, turned(pose.translation)};
  }
}

}  // namespace chain_tracker
