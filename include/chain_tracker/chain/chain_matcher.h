// SPDX-License-Identifier: BSD-3-Clause
/// Matching a chain of segments, each under several orientations and scales (thesis ch. 3.4.2).
///
/// Given the poses of its segments, the whole object is one chain of nodes: parts, and joints,
/// which cost nothing by themselves and belong to both segments they join. So the best pose of each
/// segment follows from messages merged by min at the joints, and time stays linear in the parts
/// and in the poses of a segment.
#pragma once

#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/chain_model.h"
#include "chain_tracker/chain/chain_solver.h"
#include "chain_tracker/chain/pose_grid.h"

namespace chain_tracker {

/// Where the nodes of a segment may be, and what that costs. The joint between two segments has the
/// same states in both.
struct SegmentCandidates {
  int step = 1;                      ///< of the lattices [px]
  cv::Size states;                   ///< of every node: columns and rows
  std::vector<cv::Point2d> origins;  ///< position of each node's state (0, 0) [px]
  std::vector<cv::Mat1f> costs;      ///< of each node's states; a joint's are zero

  /// Position of a node's state, which may lie between lattice points [px].
  cv::Point2d positionOf(size_t node, const cv::Point2d& state) const {
    return origins[node] + state * double(step);
  }
};

/// The springs of a segment under a pose, sampled between the candidates of its nodes.
ChainEdges sampleEdges(const SegmentLayout& segment, const SegmentCandidates& candidates,
                       const SegmentPose& pose);

/// The same segment in every argument has the same index.
struct MatchingProblem {
  const std::vector<SegmentLayout>& segments;
  const ChainModel& model;
  const std::vector<SegmentPose>& previous;
  const std::vector<PoseGrid>& poses;
  const std::vector<SegmentCandidates>& candidates;
};

struct SegmentMatch {
  size_t pose = 0;                ///< index of the best one into the segment's grid
  cv::Mat1d energies;             ///< least energy of the whole chain with the segment in each pose
  std::vector<cv::Point> states;  ///< of the nodes in the best chain
};

struct ChainMatch {
  double energy = 0.0;                 ///< +infinity if the springs allow no chain
  std::vector<SegmentMatch> segments;  ///< their states are empty if there is no chain
  bool found() const { return !segments.front().states.empty(); }
};

/// The chain and the poses of least energy, temporal and joint costs included.
/// O(parts x poses x states x offsets of a stencil), and O(states x poses^2) at a limited joint.
ChainMatch matchChain(const MatchingProblem& problem, ChainSolverWorkspace& workspace);

}  // namespace chain_tracker
