// SPDX-License-Identifier: BSD-3-Clause
/// The fewest reads of passes, remembered.
#pragma once

#include <map>
#include <vector>

#include "read_alignment.h"

namespace chain_tracker::haar {

/// Supports are known by numbers; a pass is the numbers of what it reads, in any order.
class PassReads {
 public:
  /// The number of a support.
  int idOf(const Support& support);
  const Support& support(int id) const { return supports_[static_cast<size_t>(id)]; }
  int size(int id) const { return static_cast<int>(support(id).size()); }

  /// Most values that two supports share.
  int overlap(int a, int b);
  /// False if it is proven that the pass reads more than `most` values.
  bool mayFit(std::vector<int> pass, int most);
  /// No shifts read fewer values; the fewest reads, where they can be found with limited work.
  int least(const std::vector<int>& pass);
  /// Pairs of values that were compared so far.
  std::int64_t work() const { return work_; }

 private:
  struct Known {
    int too_few = 0;  ///< proven not to be enough
    int enough = 0;   ///< not proven to be too few; 0: not known
  };

  std::vector<Support> supports_;
  std::map<std::vector<std::pair<int, int>>, int> ids_;
  std::vector<std::vector<int>> overlaps_;  ///< 0: not known yet
  std::map<std::vector<int>, Known> known_;
  std::int64_t work_ = 0;
};

}  // namespace chain_tracker::haar
