// SPDX-License-Identifier: BSD-3-Clause
/// A map inside a larger one, to catch reads and writes beyond its borders.
#pragma once

#include <string>

#include <opencv2/core.hpp>

namespace chain_tracker {

/// The rows of the map are not adjacent in memory, as in any view of a larger image.
class GuardedMap {
 public:
  /// All cells around the map hold `guard`: tempting values show wrong reads.
  GuardedMap(const cv::Size& size, float guard);

  /// A view of the cells inside; whoever keeps its size writes into this memory.
  cv::Mat1f& map() { return map_; }

  /// Whether `map` is still a view of this memory, not a map of its own.
  bool holds(const cv::Mat1f& map) const { return map.datastart == memory_.datastart; }

  /// Empty if no cell around the map was written; otherwise the first one that was.
  std::string damage() const;

 private:
  cv::Mat1f memory_;
  cv::Mat1f map_;
  float guard_;
};

}  // namespace chain_tracker
