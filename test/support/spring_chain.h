// SPDX-License-Identifier: BSD-3-Clause
/// Chains of springs, and what these cost by their documentation.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/pose_grid.h"
#include "chain_tracker/chain/segment_candidates.h"
#include "support/brute_force.h"

namespace chain_tracker {

/// A chain of the given edges, starting at the frame's origin.
SegmentLayout chainOf(const std::vector<EdgeLayout>& edges);

std::vector<cv::Point2d> placed(const SegmentLayout& segment, const Similarity& transform);

/// The springs of the model in the image, as its documentation tells them: turned and scaled with
/// the pose, both variances widened by rounding to the lattice.
brute_force::EdgeCost springsOf(const SegmentLayout& segment, const SegmentPose& pose,
                                const SegmentCandidates& candidates);

}  // namespace chain_tracker
