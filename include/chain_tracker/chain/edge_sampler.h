// SPDX-License-Identifier: BSD-3-Clause
/// The springs of a segment, sampled between the candidates of its nodes.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_edges.h"
#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/pose_grid.h"
#include "chain_tracker/chain/segment_candidates.h"

namespace chain_tracker {

/// A grid of cells has only three different springs, of which two point against each other, and
/// sampling one costs more than its message; between lattices that are as many steps apart, even
/// the stencils are the same. Kept from call to call so that no memory is allocated once sizes have
/// settled.
class EdgeSampler {
 public:
  /// `edges` becomes the springs of the segment under a pose. O(offsets of all different springs).
  void sample(const SegmentLayout& segment, const SegmentCandidates& candidates,
              const SegmentPose& pose, ChainEdges& edges);

 private:
  struct Request;
  struct Spring {
    size_t edge;
    cv::Point2d rest;
    EdgeStencil stencil;
    std::vector<std::pair<cv::Point, size_t>> kinds;  ///< by the steps between the lattices
  };

  Spring* sampled(const Request& request, size_t edge, const cv::Point2d& rest, double turn);
  Spring& newSpring(size_t edge, const cv::Point2d& rest);
  Spring& springOf(const Request& request, size_t edge, const cv::Point2d& rest);
  size_t kindOf(const Request& request, size_t edge, ChainEdges& edges);

  size_t used_ = 0;
  std::vector<Spring> springs_;  ///< the memory of those behind the used ones is kept
};

}  // namespace chain_tracker
