// SPDX-License-Identifier: BSD-3-Clause
/// Whether a tracker finds the object again that comes out from behind something.
#pragma once

#include "chain_tracker/evaluation/metrics.h"

namespace chain_tracker {

/// Frames within which an object has to be found again after it came out.
constexpr int kFramesToRecover = 10;

/// An occlusion hides more than a third of the true points and is over when it hides at most a
/// tenth. It counts once kFramesToRecover frames with truth have followed: those cut short by the
/// next one or by the end of the sequence tell nothing.
class OcclusionRecovery {
 public:
  /// `tolerance`: mean error of the visible points of an object that is found [px].
  explicit OcclusionRecovery(double tolerance) : tolerance_(tolerance) {}

  /// The next frame; one without true points is passed over. O(points).
  void observe(const FrameScore& frame);

  int occlusions() const { return occlusions_; }
  int recovered() const { return recovered_; }

 private:
  double tolerance_;
  bool is_occluded_ = false;
  int frames_left_ = 0;  ///< in which the object may still be found
  bool is_found_ = false;
  int occlusions_ = 0;
  int recovered_ = 0;
};

}  // namespace chain_tracker
