// SPDX-License-Identifier: BSD-3-Clause
/// What the tracker knows about an object after a frame.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/tracking_status.h"
#include "chain_tracker/image/pixel_geometry.h"

namespace chain_tracker {

struct PartState {
  cv::Point2d position;      ///< centre of the part's window [px]
  double orientation = 0.0;  ///< of its segment; along the chain for deformable ones [rad]
  double side = 0.0;         ///< of the window [px]
  /// [0, 1]: 0 where the window shows nothing of the object.
  double confidence = 0.0;
  bool visible = false;  ///< false: hidden, the position comes from its neighbours
  /// Of the position [px^2]; NaN where the search window gives no curvature.
  cv::Matx22d covariance = cv::Matx22d::all(0.0);
};

struct SegmentState {
  std::string name;
  Similarity image_from_segment;  ///< translation: where the segment's centre is [px]
  /// [0, 1]: mean over its parts, weighted by how much of the object their windows show.
  double confidence = 0.0;
  int first_part = 0;  ///< index into ChainState::parts
  int part_count = 0;
};

/// A point given at initialisation, carried by the parts ever since.
struct CarriedPoint {
  cv::Point2d position;  ///< [px]
  double confidence = 0.0;
  bool visible = false;
};

/// While the object is LOST, `confidence` is of the best chain found, which is not believed; all
/// parts, segments and points are hidden, with confidence 0.
struct ChainState {
  TrackingStatus status = TrackingStatus::kInitializing;
  double confidence = 0.0;  ///< [0, 1]: as of a segment, over all parts
  std::vector<PartState> parts;
  std::vector<SegmentState> segments;
  std::vector<CarriedPoint> points;  ///< in the order given at initialisation
  std::vector<cv::Point2d> outline;  ///< [px]; see CarriedShape and ObjectShape::carry()
  cv::Rect2d box;                    ///< upright [px]; see the same
};

/// The parts of a segment, where a state or a vector holds them; it must live as long.
class SegmentParts {
 public:
  SegmentParts(const ChainState& state, const SegmentState& segment)
      : first_(state.parts.data() + segment.first_part),
        count_(static_cast<size_t>(segment.part_count)) {}
  SegmentParts(const std::vector<PartState>& parts) : first_(parts.data()), count_(parts.size()) {}

  const PartState* begin() const { return first_; }
  const PartState* end() const { return first_ + count_; }
  size_t size() const { return count_; }
  const PartState& operator[](size_t k) const { return first_[k]; }

 private:
  const PartState* first_;
  size_t count_;
};

/// The pose of the whole: the mean over the segments, of which there must be one, weighted by their
/// number of parts: positions arithmetically, angles on the circle, scales geometrically.
Similarity meanPose(const ChainState& state);

}  // namespace chain_tracker
