// SPDX-License-Identifier: BSD-3-Clause
/// The tracker: the object's pose in every frame, given its pose in the first (thesis ch. 3.4).
///
/// Each update looks the colours up, compares every part's window with the histogram learned in
/// the first frame, matches the whole chain at once by dynamic programming over a small set of
/// orientations and scales, refines the winner at full resolution, and judges it. An object that
/// is less sure than usual is looked for elsewhere, too; one that is lost, farther away in every
/// frame, in every other one at any orientation.
#pragma once

#include <memory>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_model.h"
#include "chain_tracker/chain/chain_state.h"

namespace chain_tracker {

class ChainTracker {
 public:
  /// Learns the object at `points` [px] in `image` (CV_8UC3 BGR or CV_8UC1).
  /// The layouts say what points they take: two ends or four corners (elongated), four corners
  /// (planar), a polyline of at least two points (deformable), the centres of at
  /// least two parts (points).
  /// Throws std::invalid_argument naming the thing, its value and what is allowed: a faulty model,
  /// an empty image or one of another type, one smaller than a part, a wrong number of points,
  /// points that coincide, are not finite or lie outside the image, or a shape around which the
  /// image is of one colour.
  ChainTracker(const ChainModel& model, const cv::Mat& image,
               const std::vector<cv::Point2d>& points);
  ~ChainTracker();
  ChainTracker(ChainTracker&&) noexcept;
  ChainTracker& operator=(ChainTracker&&) noexcept;

  /// Tracks into the next frame and returns the state there.
  /// Throws std::invalid_argument if the image is empty or differs in size or type from the first;
  /// the tracker is then as before.
  /// Time: linear in the number of parts; linear in the area of a part's search window. A frame in
  /// which the object begins to be in doubt takes three searches, every other one after it three
  /// or, for a single deformable segment, every one up to eight, the widest of them over 81 x 81
  /// candidates a part. While segments at an end of a chain are hidden, every other frame takes
  /// two. An open line that nothing marks clearly takes up to two narrow ones more in every frame,
  /// in which its ends are looked for.
  ///
  /// Memory: after the first frames, none is allocated but for what is new: parts turned as never
  /// before, windows of another size, searches of an object that is in doubt or partly hidden.
  const ChainState& update(const cv::Mat& image);

  /// Threads that an update may use from now on; 1 at first. They share the maps of the parts'
  /// costs and the poses of the segments where these are large, above all while the object is in
  /// doubt: what update() returns does not depend on them. They are OpenCV's, of which there are
  /// cv::getNumThreads(); inside another cv::parallel_for_() there is one.
  /// Throws std::invalid_argument unless `threads` is in [1, 256].
  void useThreads(int threads);

  const ChainState& state() const;
  const ChainModel& model() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace chain_tracker
