// SPDX-License-Identifier: BSD-3-Clause
/// Everything of an object's state that follows from where its parts and segments are.
#pragma once

#include <cstddef>
#include <vector>

#include "chain_tracker/chain/carried_shape.h"
#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/chain_state.h"
#include "chain_tracker/image/convex_hull.h"

namespace chain_tracker {

class ObjectShape {
 public:
  explicit ObjectShape(std::vector<SegmentLayout> segments);

  /// Fills in the parts' orientations and windows, the points given at initialisation, the outline
  /// and the box, from the parts' positions and the segments' poses.
  /// A vertex at which two segments are joined lies halfway between where the two believe it to be.
  /// Several segments have the convex hull of theirs for an outline, and its bounds for a box.
  /// O(parts + points).
  void carry(ChainState& state);

 private:
  void orient(std::size_t m, ChainState& state) const;

  std::vector<SegmentLayout> segments_;
  std::vector<CarriedShape> shapes_;
  ConvexHull hull_;
};

}  // namespace chain_tracker
