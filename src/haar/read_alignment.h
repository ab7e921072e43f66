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

struct UnionAnswer {
  bool is_possible = false;       ///< false: proven that no shifts do it
  std::vector<cv::Point> shifts;  ///< that do it, of each support; empty if none were found
  std::int64_t work = 0;          ///< pairs of values that were compared
};

/// Whether supports can be shifted so that they read at most `most` values altogether. In some best
/// alignment every support shares a value with others, else some could be shifted until they do:
/// so supports are added one by one, each at a shift at which it meets those there. A support that
/// fits into what is read already costs nothing and is placed at once; one that would add too much
/// at every shift proves that there is no way. Gives up once it has compared `max_work` pairs of
/// values.
UnionAnswer unionWithin(const std::vector<Support>& supports, int most, std::int64_t max_work);

struct ReadAlignment {
  std::vector<cv::Point> shifts;  ///< of each support
  int reads = 0;
};

/// Improves a greedy alignment as long as unionWithin() finds one with fewer reads.
ReadAlignment alignReads(const std::vector<Support>& supports, std::int64_t max_work = 1000000);

}  // namespace chain_tracker::haar
