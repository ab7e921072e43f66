// SPDX-License-Identifier: BSD-3-Clause
/// Orientations and scales of a segment that are tried in a frame (thesis ch. 3.2.3).
#pragma once

#include <cstddef>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_model.h"

namespace chain_tracker {

/// Orientation and scale of a segment.
struct SegmentPose {
  double orientation = 0.0;  ///< [rad]
  double scale = 1.0;
};

/// Poses tried around a middle one: of a grid over orientation and log scale, its middle row and
/// column, as objects seldom turn and rescale by several steps at once, and the number of poses
/// then is a sum and no product.
struct PoseGrid {
  SegmentPose middle;
  int orientations = 1;           ///< odd
  double orientation_step = 0.0;  ///< [rad]
  int scales = 1;                 ///< odd
  double scale_step = 0.0;        ///< of the log scale

  size_t size() const { return static_cast<size_t>(orientations + scales - 1); }
  /// Where in the grid a pose lies: column (scale) and row (orientation). All orientations come
  /// first, then the other scales.
  cv::Point cellOf(size_t index) const;
  /// `row` and `column` may lie between poses.
  SegmentPose at(double row, double column) const;
  SegmentPose at(size_t index) const;
};

/// Cost of turning and rescaling from the previous frame's pose (temporal term of thesis ch.
/// 3.2.3). Displacement has its own: SearchModel::travel_weight.
double temporalCost(const SegmentModel& model, const SegmentPose& previous,
                    const SegmentPose& pose);

/// Cost of the angle between two joined segments: none within the joint's limits; beyond them every
/// 0.05 rad is a standard deviation, so that a pose slightly outside is never impossible.
double jointCost(const JointModel& joint, const SegmentPose& before, const SegmentPose& behind);

/// Whether jointCost() is zero for any two poses.
bool isFree(const JointModel& joint);

/// The angle to which a joint returns where nothing tells how it is bent, as JointModel counts it.
struct JointRest {
  double angle = 0.0;  ///< [rad]
  double sigma = 0.0;  ///< standard deviation of the bend from there [rad]; 0: it rests anywhere
};

/// Cost of the angle between two joined segments that are not seen; at most 20, as they may have
/// bent by any angle meanwhile.
double restCost(const JointRest& rest, const SegmentPose& before, const SegmentPose& behind);

/// The pose between those of the grid at which parabolas through the energies (orientations x
/// scales; infinite where no pose was tried) of the best pose and of its neighbours are least. The
/// best one itself where it has no neighbours on both sides.
SegmentPose interpolatePose(const PoseGrid& poses, const cv::Mat1d& energies);

}  // namespace chain_tracker
