// SPDX-License-Identifier: BSD-3-Clause
/// The points given at initialisation, carried by the parts: whoever names two ends or five joints
/// gets the same points back in every frame, whatever parts the model puts between them.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/chain_state.h"

namespace chain_tracker {

/// The shape that initialised a segment. On a rigid layout it moves with the segment's similarity,
/// which averages over all parts; on a deformable one each point moves with the nearest edge.
class CarriedShape {
 public:
  explicit CarriedShape(const SegmentLayout& segment);

  /// Appends the points as they are now; `parts` are the segment's. O(points).
  void addPoints(const SegmentState& segment, const SegmentParts& parts,
                 std::vector<CarriedPoint>& points) const;

  /// Appends what spans the outline: the corners of the initial box, turned and scaled with the
  /// segment. Points have those of their convex hull instead; what bends anywhere soon leaves its
  /// box, and has the places of its points and parts, of which the hull is the outline.
  void addOutline(const SegmentState& segment, const SegmentParts& parts,
                  std::vector<cv::Point2d>& outline) const;
  /// Whether that hull is still to be taken.
  bool outlineIsHull() const { return deformable_; }

  /// Upright box of the object: a box given by upright corners moves and rescales but does not
  /// turn; all else gives the bounds of its outline.
  cv::Rect2d box(const SegmentState& segment, const std::vector<cv::Point2d>& outline) const;

 private:
  struct Anchor {
    cv::Point2d point;  ///< rigid: in the segment's frame; deformable: in its edge's frame
    size_t part = 0;    ///< deformable: start of the edge; rigid: nearest part
  };

  static cv::Point2d carried(const Anchor& anchor, const SegmentParts& parts);

  bool deformable_ = false;
  bool box_turns_ = false;
  cv::Rect2d unturned_;  ///< the box around the segment's centre as it was at first
  std::vector<Anchor> anchors_;
  std::vector<cv::Point2d> corners_;
};

/// Direction of the chain at part `k` of a deformable segment; the segment's own orientation on a
/// rigid one [rad].
double partOrientation(const SegmentLayout& layout, const SegmentState& segment,
                       const SegmentParts& parts, size_t k);

}  // namespace chain_tracker
