// SPDX-License-Identifier: BSD-3-Clause
/// How kernels of one pass are shifted against one another so that they read the fewest values.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/haar/sparse_kernel.h"

namespace chain_tracker::haar {

/// Delays that a kernel reads.
using Support = std::vector<cv::Point>;
Support supportOf(const SparseKernel& kernel);

/// What a pass reads while kernels are added to it and taken out.
class ReadSet {
 public:
  struct Placement {
    cv::Point shift;
    int new_reads = 0;
  };

  int size() const { return static_cast<int>(counts_.size()); }
  /// The shift at which most values are read already; `tie_breaker` chooses among equal ones.
  Placement bestPlacement(const Support& support, std::uint32_t tie_breaker = 0) const;
  void add(const Support& support, const cv::Point& shift);
  void remove(const Support& support, const cv::Point& shift);

 private:
  std::unordered_map<std::uint64_t, int> counts_;  ///< readers of each value
};

struct ReadAlignment {
  std::vector<cv::Point> shifts;  ///< of each support
  int reads = 0;
  bool is_proven = false;  ///< no other shifts read fewer values
};

/// Branch and bound from a greedy alignment. In a best alignment every set shares a value with
/// another, else one could be shifted until it does: so sets are added one by one, each at a shift
/// at which it meets those there. Gives up the proof after `max_steps`.
ReadAlignment alignReads(const std::vector<Support>& supports, int max_steps = 20000);

}  // namespace chain_tracker::haar
