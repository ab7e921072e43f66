// SPDX-License-Identifier: BSD-3-Clause
/// Trees whose sums fit in 16 bits, for twice as many values in a vector and half the memory.
#pragma once

#include <vector>

#include "chain_tracker/haar/double_difference.h"
#include "chain_tracker/haar/pass_tree.h"

namespace chain_tracker::haar {

/// Whether 16 bits hold all values of a range, signed or unsigned.
bool fits16(const ValueRange& range);

/// A response that needs 32 bits drags all its passes into 32 bits, unless the values that it is
/// summed up from are known to fit in 16. So its chain of passes is replaced by one through a
/// kernel whose range fits, where there is one and the chain moves no more bytes: each has a few
/// accesses more, of half the size. `ranges`: of the features, for pixels up to `max_pixel`.
PassTree narrowedTree(const PassTree& tree, const std::vector<ValueRange>& ranges, int max_pixel);

}  // namespace chain_tracker::haar
