// SPDX-License-Identifier: BSD-3-Clause
/// Trackers side by side: the chain tracker and those that OpenCV offers.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_model.h"
#include "chain_tracker/chain/chain_state.h"

namespace chain_tracker {

/// What any tracker reports of a frame; a box tracker has no parts and no points.
struct TrackedFrame {
  std::string state;        ///< TRACKING, OCCLUDED, LOST, ...
  double confidence = 0.0;  ///< [0, 1]; box trackers: 1 while they report success
  bool lost = false;
  cv::Rect2d box;  ///< upright [px]
  /// Of an object that turns, if the tracker tells [px]; else empty.
  std::vector<cv::Point2d> outline;
  double theta = 0.0;  ///< [rad]
  double scale = 1.0;
  std::vector<PartState> parts;
  std::vector<CarriedPoint> points;
};

class EvaluatedTracker {
 public:
  virtual ~EvaluatedTracker() = default;
  virtual std::string name() const = 0;

  /// Learns the object in its first frame. Throws std::invalid_argument if it cannot be tracked.
  virtual TrackedFrame start(const cv::Mat& image) = 0;

  /// Tracks into the next frame.
  virtual TrackedFrame update(const cv::Mat& image) = 0;
};

/// The chain tracker, started at `points`, of which an update uses up to `threads` in [1, 256].
std::unique_ptr<EvaluatedTracker> makeChainTracker(const ChainModel& model,
                                                   const std::vector<cv::Point2d>& points,
                                                   int threads);

/// Names that makeBaseline() knows in this build: camshift and mil always, kcf, csrt and medianflow
/// where OpenCV was built with its contributed modules.
std::vector<std::string> baselineNames();

/// One of OpenCV's trackers with its default parameters, started at `box` cut to whole pixels and
/// to the image, which they require. Throws std::invalid_argument naming the tracker if it is not
/// known or not built in.
std::unique_ptr<EvaluatedTracker> makeBaseline(const std::string& name, const cv::Rect2d& box);

}  // namespace chain_tracker
