// SPDX-License-Identifier: BSD-3-Clause
/// Pictures of an evaluation: the overlay video and the worst frames.
#pragma once

#include <string>

#include <opencv2/videoio.hpp>

#include "chain_tracker/evaluation/evaluation_run.h"

namespace chain_tracker {

/// The frame with the tracked parts and box in green (a red note if lost) and the truth in blue.
cv::Mat drawComparison(const SourceFrame& frame, const TrackedFrame& tracked,
                       const GroundTruth& truth);

/// A video of drawComparison(); does nothing if its path is empty.
class OverlayVideo {
 public:
  explicit OverlayVideo(std::string path);
  /// Throws std::runtime_error naming the file if it cannot be written.
  void add(const SourceFrame& frame, const TrackedFrame& tracked, const GroundTruth& truth);

 private:
  std::string path_;
  cv::VideoWriter writer_;
};

/// A filmstrip of the chain tracker's worst frames by overlap, or by point error where there is no
/// overlap: up to eight, some way from each other, in order of time. `frames` is read from its
/// start. Nothing without truth.
void writeWorstFrames(FrameSource& frames, const EvaluationResult& result, const GroundTruth& truth,
                      const std::string& path);

}  // namespace chain_tracker
