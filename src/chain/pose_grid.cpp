// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/pose_grid.h"

#include <algorithm>
#include <cmath>

#include "chain_tracker/image/pixel_geometry.h"

namespace chain_tracker {
namespace {

/// Of the angle beyond a joint's limits [rad].
constexpr double kLimitSigma = 0.05;

constexpr double kMostRestCost = 20.0;

double halfSquare(double x) { return 0.5 * x * x; }

/// Where the parabola through three equidistant values is least, in steps from the middle one,
/// which must be the smallest; 0 if it has no curvature or a value is infinite.
double parabolaMinimum(double before, double middle, double after) {
  const double curvature = before - 2.0 * middle + after;
  if (!std::isfinite(curvature) || curvature <= 0.0) return 0.0;
  return std::clamp(0.5 * (before - after) / curvature, -0.5, 0.5);
}

}  // namespace

SegmentPose PoseGrid::at(double row, double column) const {
  const int middle_row = orientations / 2;
  const int middle_column = scales / 2;
  return {wrapAngle(middle.orientation + (row - middle_row) * orientation_step),
          middle.scale * std::exp((column - middle_column) * scale_step)};
}

SegmentPose PoseGrid::at(size_t index) const {
  const cv::Point cell = cellOf(index);
  return at(cell.y, cell.x);
}

cv::Point PoseGrid::cellOf(size_t index) const {
  const int i = static_cast<int>(index);
  if (i < orientations) return {scales / 2, i};
  const int column = i - orientations;
  return {column < scales / 2 ? column : column + 1, orientations / 2};
}

double temporalCost(const SegmentModel& model, const SegmentPose& previous,
                    const SegmentPose& pose) {
  const double turn = wrapAngle(pose.orientation - previous.orientation);
  const double growth = std::log(pose.scale / previous.scale);
  return halfSquare(turn / model.orientation_sigma) + halfSquare(growth / model.scale_sigma);
}

double jointCost(const JointModel& joint, const SegmentPose& before, const SegmentPose& behind) {
  const double angle = wrapAngle(behind.orientation - before.orientation);
  if (angle >= joint.min_angle && angle <= joint.max_angle) return 0.0;
  // The limit reached first may lie across the half turn.
  const double excess = std::min(std::abs(wrapAngle(angle - joint.min_angle)),
                                 std::abs(wrapAngle(angle - joint.max_angle)));
  return halfSquare(excess / kLimitSigma);
}

bool isFree(const JointModel& joint) {
  return joint.min_angle <= -kFreeJoint && joint.max_angle >= kFreeJoint;
}

double restCost(const JointRest& rest, const SegmentPose& before, const SegmentPose& behind) {
  if (rest.sigma <= 0.0) return 0.0;
  const double bend = wrapAngle(behind.orientation - before.orientation - rest.angle);
  return std::min(kMostRestCost, halfSquare(bend / rest.sigma));
}

SegmentPose interpolatePose(const PoseGrid& poses, const cv::Mat1d& energies) {
  int best[2] = {0, 0};
  cv::minMaxIdx(energies, nullptr, nullptr, best, nullptr);
  const int row = best[0];
  const int column = best[1];
  double row_offset = 0.0;
  double column_offset = 0.0;
  if (row > 0 && row + 1 < poses.orientations) {
    row_offset = parabolaMinimum(energies(row - 1, column), energies(row, column),
                                 energies(row + 1, column));
  }
  if (column > 0 && column + 1 < poses.scales) {
    column_offset = parabolaMinimum(energies(row, column - 1), energies(row, column),
                                    energies(row, column + 1));
  }
  return poses.at(row + row_offset, column + column_offset);
}

}  // namespace chain_tracker
