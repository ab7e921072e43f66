// SPDX-License-Identifier: BSD-3-Clause
/// Lets what bends anywhere rest where it is sought, so that it may bend as far as it likes, but
/// not at once.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/chain_model.h"
#include "chain_tracker/chain/chain_state.h"

namespace chain_tracker {

class SpringRelaxation {
 public:
  /// `layout`: the segments in the first frame, whose shape a model may remember.
  SpringRelaxation(const ChainModel& model, const std::vector<SegmentLayout>& layout);

  /// The edges of deformable segments come to rest as restDirections() has it from `state`, and may
  /// bend by `looseness` times what they may between two frames. O(edges).
  void relax(const ChainState& state, double looseness, std::vector<SegmentLayout>& layout);

 private:
  std::vector<double> bend_sigmas_;                    // of the segments
  std::vector<std::vector<double>> remembered_turns_;  // of each segment's edges
  // Of a segment.
  std::vector<cv::Point2d> nodes_;
  std::vector<bool> nodes_hidden_;
  std::vector<double> directions_;
  std::vector<bool> edges_hidden_;
  std::vector<double> rest_;
};

}  // namespace chain_tracker
