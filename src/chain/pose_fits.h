// SPDX-License-Identifier: BSD-3-Clause
/// The poses of all segments from where their parts were found, and how far their sizes are
/// believed.
#pragma once

#include <vector>

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/chain_model.h"
#include "chain_tracker/chain/chain_state.h"
#include "chain_tracker/chain/pose_grid.h"
#include "segment_fit.h"

namespace chain_tracker {

/// Half the coarse steps around the best coarse pose. Where the coarse search has a
/// single hypothesis, the fits alone turn or rescale the segment, by up to the coarse step.
PoseGrid finePoses(const SegmentModel& model, const SegmentPose& coarse);

class PoseFits {
 public:
  /// `length_rates`: of the segments, for fitSegment().
  PoseFits(const std::vector<SegmentModel>& models, const std::vector<SegmentLayout>& layout,
           std::vector<double> length_rates);

  double lengthRate(size_t m) const { return length_rates_[m]; }

  /// The segments of `found` come to lie as their parts do, which were found under `poses` and are
  /// as sure as `found` says; `usual_confidence`: of the object. O(parts).
  void fit(const std::vector<SegmentPose>& poses, double usual_confidence, ChainState& found);

 private:
  void fitAll(const std::vector<SegmentPose>& poses, double scaling, ChainState& found);
  double leastGrowth(const std::vector<SegmentPose>& poses, const ChainState& found) const;

  std::vector<SegmentModel> models_;
  std::vector<SegmentLayout> layout_;
  std::vector<double> length_rates_;
  SegmentFitWorkspace workspace_;
};

}  // namespace chain_tracker
