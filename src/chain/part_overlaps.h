// SPDX-License-Identifier: BSD-3-Clause
/// Parts that have come to lie on one another, as when the chains of two fingers both follow one of
/// them: what they see is there only once (the double counting of pictorial structures).
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "chain_tracker/chain/chain_state.h"

namespace chain_tracker {

class PartOverlaps {
 public:
  /// `initial`: the parts in the first frame.
  explicit PartOverlaps(const std::vector<PartState>& initial);

  /// `shares` become, of what each part sees, its share among the parts that now lie on it, in
  /// (0, 1]; parts that did so in the first frame do not count. O(parts^2).
  void computeShares(const std::vector<PartState>& parts, std::vector<double>& shares) const;

 private:
  std::vector<std::pair<size_t, size_t>> apart_;  ///< in the first frame
};

}  // namespace chain_tracker
