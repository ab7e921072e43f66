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
#include "chain_tracker/chain/edge_sampler.h"
#include "chain_tracker/chain/pose_grid.h"
#include "chain_tracker/chain/segment_candidates.h"

namespace chain_tracker {

/// The same segment in every argument has the same index.
struct MatchingProblem {
  const std::vector<SegmentLayout>& segments;
  const ChainModel& model;
  const std::vector<SegmentPose>& previous;
  const std::vector<JointRest>& rests;  ///< of the joints, one fewer than segments
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

/// [segment][pose]: a map over the states of a node.
using PoseMaps = std::vector<std::vector<cv::Mat1f>>;

/// Of a thread: passes over a segment, under one pose after the other.
struct PassWorkspace {
  std::vector<ChainSolverWorkspace> solvers;  ///< of the segments
  EdgeSampler sampler;
  ChainEdges edges;
  ChainEdges backward_edges;
  std::vector<cv::Mat1f> costs;  ///< of a segment's nodes
  // The best of its passes over the last segment.
  size_t best_pose = 0;
  double best_energy = 0.0;
  ChainEdges best_edges;
  std::vector<cv::Mat1f> best_forward;  ///< solvers.back().forward
};

/// Kept from call to call so that no memory is allocated once sizes have settled.
struct ChainMatcherWorkspace {
  int threads = 1;  ///< that share the work, at least 1
  std::vector<PassWorkspace> passes;
  PoseMaps ahead;   ///< segments up to this one, which end in each state
  PoseMaps behind;  ///< segments from this one on, which begin in each state
  PoseMaps into;    ///< messages to the segment from the one before
  PoseMaps from;    ///< messages to the segment from the one behind
  cv::Mat1f sum;
  ChainMatch match;
};

/// The chain and the poses of least energy, temporal, joint and rest costs included; valid until
/// the workspace is used again. O(parts x poses x states x offsets of a stencil), and O(states x
/// poses^2) at a joint that is limited or rests.
const ChainMatch& matchChain(const MatchingProblem& problem, ChainMatcherWorkspace& workspace);

}  // namespace chain_tracker
