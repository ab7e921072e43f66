// SPDX-License-Identifier: BSD-3-Clause
/// Where an object may be that was lost: its segments, as they last were, moved and turned to
/// wherever the colours of some of their parts fit best (a generalised Hough transform). One
/// segment is placed anywhere in a wide region at any orientation, the others hang from it by their
/// joints. All that takes less time than one search for the chain in as wide a region; that search
/// is to follow around the place found, where the object has bent and rescaled meanwhile.
#pragma once

#include <limits>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_model.h"
#include "chain_tracker/chain/part_costs.h"
#include "chain_tracker/chain/pose_grid.h"
#include "chain_tracker/image/pixel_geometry.h"
#include "voter_costs.h"

namespace chain_tracker {

struct RigidSegment {
  std::vector<Voter> voters;  ///< at least one
  double side = 0.0;          ///< of their windows [px]
  SegmentPose pose;
};

/// Between a segment and the next one.
struct Hinge {
  cv::Point2d position;  ///< where the object was [px]
  JointModel limits;
  JointRest rest;
};

/// A turn and the cell of what it is about.
struct Placement {
  int turn = 0;
  cv::Point middle;
  double cost = std::numeric_limits<double>::infinity();
};

/// The placement whose parts cost least, the first one of several: over all cells in `middles` and
/// `turns` equal turns, of which turn 0 is none. `costs[k]`: of part k with its centre in each
/// cell, equal sizes; `offsets[k]`: of part k from the middle [cells], rounded to whole cells once
/// turned, with which it must stay on the map. O(turns x parts x cells of `middles`), which
/// `threads` share.
Placement cheapestPlacement(const std::vector<cv::Mat1f>& costs,
                            const std::vector<cv::Point2d>& offsets, const cv::Rect& middles,
                            int turns, int threads = 1);

class PlacementSearch {
 public:
  PlacementSearch(const AppearanceModel& model, const cv::Size& image_size)
      : model_(model), image_(cv::Point(), image_size) {}

  /// That share the work, at least 1.
  void useThreads(int threads) { workspace_.threads = threads; }

  /// The rigid motion of each segment [px], exact to about a third of a window. The middle of the
  /// segment that is placed freely stays within `radius` [px] to each side of where the segments
  /// were, and inside the image. `hinges`: one fewer than segments.
  std::vector<Similarity> find(const std::vector<RigidSegment>& segments,
                               const std::vector<Hinge>& hinges, double radius,
                               FramePixels& pixels);

  /// The same where those that are `seen`, at least one, stay as they are: the others hang from
  /// them.
  std::vector<Similarity> hang(const std::vector<RigidSegment>& segments,
                               const std::vector<Hinge>& hinges, const std::vector<bool>& seen,
                               FramePixels& pixels);

 private:
  AppearanceModel model_;
  cv::Rect2d image_;
  PartCostsWorkspace workspace_;
};

}  // namespace chain_tracker
