// SPDX-License-Identifier: BSD-3-Clause
/// Matching a segment under several orientations and scales (thesis ch. 3.2.3 and 3.4.2).
#pragma once

#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/chain_model.h"
#include "chain_tracker/chain/chain_solver.h"
#include "chain_tracker/chain/part_costs.h"

namespace chain_tracker {

/// Orientation and scale of a segment.
struct SegmentPose {
  double orientation = 0.0;  ///< [rad]
  double scale = 1.0;
};

/// Poses tried around a middle one: a grid over orientation and log scale.
struct PoseGrid {
  SegmentPose middle;
  int orientations = 1;           ///< odd
  double orientation_step = 0.0;  ///< [rad]
  int scales = 1;                 ///< odd
  double scale_step = 0.0;        ///< of the log scale

  size_t size() const { return static_cast<size_t>(orientations * scales); }
  /// Pose of an index, scales varying fastest; `row` and `column` may lie between poses.
  SegmentPose at(double row, double column) const;
};

/// Cost of turning and rescaling from the previous frame's pose (temporal term of thesis ch.
/// 3.2.3). There is none on displacement: slow and fast shifts are equally likely.
double temporalCost(const SegmentModel& model, const SegmentPose& previous,
                    const SegmentPose& pose);

/// The springs of a segment under a hypothesis, sampled between the candidates of its parts.
std::vector<EdgeStencil> sampleEdges(const SegmentLayout& segment, const CandidateGrid& grid,
                                     const SegmentPose& pose);

struct PoseMatch {
  int row = 0;                    ///< of the hypothesis of least energy: its orientation
  int column = 0;                 ///< and its scale
  cv::Mat1d energies;             ///< orientations x scales; +infinity: the springs allow no chain
  std::vector<cv::Point> states;  ///< of the parts under the best one; empty if there is none
  bool found() const { return !states.empty(); }
  double energy() const { return energies(row, column); }
};

/// The pose of least energy, temporal cost included, and its best chain.
/// O(poses x parts x states x offsets of a stencil).
PoseMatch searchPose(const SegmentLayout& segment, const SegmentModel& model,
                     const SegmentPose& previous, const PoseGrid& poses, const CandidateGrid& grid,
                     const std::vector<cv::Mat1f>& costs, ChainSolverWorkspace& workspace);

/// The pose between those of the grid at which parabolas through the energies of the best one and
/// of its neighbours are least. The best one itself where it has no neighbours on both sides.
SegmentPose interpolatePose(const PoseGrid& poses, const PoseMatch& match);

struct RefinedPart {
  cv::Point2d position;     ///< [px], between candidates
  double appearance = 0.0;  ///< cost of the candidate chosen
  cv::Matx22d covariance;   ///< [px^2], from the curvature of the min-marginal; NaN if unknown
};

/// The best chain under one pose with sub-pixel positions; empty if there is none.
std::vector<RefinedPart> refineChain(const SegmentLayout& segment, const SegmentPose& pose,
                                     const CandidateGrid& grid, const std::vector<cv::Mat1f>& costs,
                                     ChainSolverWorkspace& workspace);

}  // namespace chain_tracker
