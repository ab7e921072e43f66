// SPDX-License-Identifier: BSD-3-Clause
/// The points given at initialisation, carried by the parts: whoever names two ends or five joints
/// gets the same points back in every frame, whatever parts the model puts between them.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/chain_state.h"

namespace chain_tracker {

/// Corners of the convex hull.
std::vector<cv::Point2d> hullOf(const std::vector<cv::Point2d>& points);

/// The shape that initialised a segment. On a rigid layout it moves with the segment's similarity,
/// which averages over all parts; on a deformable one each point moves with the nearest edge.
class CarriedShape {
 public:
  explicit CarriedShape(const SegmentLayout& segment);

  /// The points now; `parts` are the segment's. O(points).
  std::vector<CarriedPoint> points(const SegmentState& segment,
                                   const std::vector<PartState>& parts) const;

  /// Corners of the initial box, turned and scaled with the segment. Points have their convex hull
  /// instead; what bends anywhere soon leaves its box, and has the hull of its points and parts.
  std::vector<cv::Point2d> outline(const SegmentState& segment,
                                   const std::vector<PartState>& parts) const;

  /// Upright box of the object: a box given by upright corners moves and rescales but does not
  /// turn; all else gives the bounds of its outline.
  cv::Rect2d box(const SegmentState& segment, const std::vector<PartState>& parts) const;

 private:
  struct Anchor {
    cv::Point2d point;  ///< rigid: in the segment's frame; deformable: in its edge's frame
    size_t part = 0;    ///< deformable: start of the edge; rigid: nearest part
  };

  bool deformable_ = false;
  bool box_turns_ = false;
  double initial_orientation_ = 0.0;
  std::vector<Anchor> anchors_;
  std::vector<cv::Point2d> corners_;
};

/// Direction of the chain at each part of a deformable segment; the segment's own orientation on a
/// rigid one [rad].
std::vector<double> partOrientations(const SegmentLayout& layout, const SegmentState& segment,
                                     const std::vector<PartState>& parts);

}  // namespace chain_tracker
