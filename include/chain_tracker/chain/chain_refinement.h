// SPDX-License-Identifier: BSD-3-Clause
/// Sub-pixel positions of the parts and how sure they are, from min-marginals.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_matcher.h"

namespace chain_tracker {

struct RefinedPart {
  cv::Point2d position;     ///< [px], between candidates
  double appearance = 0.0;  ///< cost of the candidate chosen
  cv::Matx22d covariance;   ///< [px^2], from the curvature of the min-marginal; NaN if unknown
};

/// Kept from call to call so that no memory is allocated once sizes have settled.
struct ChainRefinementWorkspace {
  ChainSolverWorkspace solver;
  EdgeSampler sampler;
  ChainEdges segment_edges;
  ChainEdges edges;  ///< of all segments as one chain, in which a joint is one node
  std::vector<cv::Mat1f> costs;
  std::vector<cv::Mat1f> marginals;
  std::vector<cv::Point> states;
  std::vector<RefinedPart> parts;
};

/// The parts of all segments, in order, in the best chain under one pose a segment; empty if the
/// springs allow none. Valid until the workspace is used again. O(parts x states x offsets of a
/// stencil).
const std::vector<RefinedPart>& refineChain(const std::vector<SegmentLayout>& segments,
                                            const std::vector<SegmentPose>& poses,
                                            const std::vector<SegmentCandidates>& candidates,
                                            ChainRefinementWorkspace& workspace);

}  // namespace chain_tracker
