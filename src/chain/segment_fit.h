// SPDX-License-Identifier: BSD-3-Clause
/// The pose of a segment from where its parts were found (thesis ch. 3.4.3).
#pragma once

#include <vector>

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/chain_state.h"
#include "chain_tracker/chain/pose_grid.h"

namespace chain_tracker {

/// Kept from call to call so that no memory is allocated once sizes have settled.
struct SegmentFitWorkspace {
  std::vector<cv::Point2d> reference;  ///< parts in the segment's frame
  std::vector<cv::Point2d> found;      ///< in the image
  std::vector<double> confidences;
  std::vector<double> weights;
};

/// Least squares over the segment's parts but those that have slid off to what looks like them,
/// weighted by confidence; at most half a step of `poses` from their middle: beyond it, the energy
/// knows better than the parts, which lean inwards wherever the object is uniform.
/// A rigid segment of which a single scale is searched, so that no energy tells it, returns to that
/// of the first frame, 1, as far as the covariances of its parts leave the scale open. One that
/// bends anywhere takes a share of `length_rate` of the change of its length in every call, on a
/// log scale; that of lengthEvidence(). O(parts).
Similarity fitSegment(const SegmentLayout& layout, const PoseGrid& poses, const SegmentParts& parts,
                      double length_rate, SegmentFitWorkspace& workspace);

}  // namespace chain_tracker
