// SPDX-License-Identifier: BSD-3-Clause
#include "occlusion_recovery.h"

namespace chain_tracker {
namespace {

constexpr double kOccluded = 1.0 / 3.0;
constexpr double kOut = 0.1;

}  // namespace

void OcclusionRecovery::observe(const FrameScore& frame) {
  const double points = frame.hidden_points + static_cast<double>(frame.point_errors.size());
  if (points == 0.0) return;
  const double hidden = frame.hidden_points / points;
  if (hidden > kOccluded) {
    is_occluded_ = true;
    frames_left_ = 0;
    return;
  }
  if (is_occluded_ && hidden <= kOut) {
    is_occluded_ = is_found_ = false;
    frames_left_ = kFramesToRecover;
  }
  if (frames_left_ == 0) return;
  is_found_ = is_found_ || (hidden <= kOut && mean(frame.point_errors) <= tolerance_);
  if (--frames_left_ > 0) return;
  ++occlusions_;
  recovered_ += is_found_ ? 1 : 0;
}

}  // namespace chain_tracker
