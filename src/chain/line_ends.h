// SPDX-License-Identifier: BSD-3-Clause
/// Where an open line ends, which alone tells how long it is and how far it lies along itself if it
/// looks the same all along: waves that run along it take its parts with them, and it comes nearer
/// unnoticed.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/chain_state.h"

namespace chain_tracker {

class LineEnds {
 public:
  /// `line`: in the first frame. One that is not open is never asked about.
  explicit LineEnds(const SegmentLayout& line);

  /// Lays `line` anew along the stretch of it that is seen, what that has no room for beyond either
  /// end in turn. False if it has room for all, or too little is seen. O(parts).
  bool stretch(ChainState& line);

  /// The same with the line a little longer at either end or a little shorter, in turn. False if
  /// too little is seen, or if it would become longer than what has no room already. O(parts).
  bool rescale(ChainState& line);

  /// How much it speaks for a line that it looks like the object by `likeness` and is seen over
  /// some length: what is longer explains more. O(parts).
  double score(const ChainState& line, double likeness);

 private:
  /// What is seen of `line`, of its length.
  double seenShare(const ChainState& line);
  bool isShort(double seen) const;
  void layAlongSeen(bool moves_last, ChainState& line);

  std::vector<double> first_lengths_;  ///< of the edges at scale 1 [px]
  double first_length_;                ///< of the line at scale 1 [px]
  double part_;                        ///< one edge, of the line
  bool stretches_last_ = false;
  int turn_ = 0;
  std::vector<double> lengths_;       ///< of the edges
  std::vector<cv::Point2d> stretch_;  ///< that is seen
};

}  // namespace chain_tracker
