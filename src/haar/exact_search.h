// SPDX-License-Identifier: BSD-3-Clause
/// The exact search of parser.h.
#pragma once

#include <optional>
#include <vector>

#include "kernel_forest.h"

namespace chain_tracker::haar {

struct ExactResult {
  std::int64_t least = 0;            ///< no forest has fewer accesses
  std::optional<KernelForest> best;  ///< with as many accesses as that, if fewer than the known
};

/// Looks for forests with fewer accesses than `known`: for one with the fewest accesses that a
/// forest could have, then for one with one more, and so on, until there is one or the work is
/// done; work is counted in comparisons of what passes read. What has been ruled out is the bound.
/// `features[i]`: how many features target i of the lattice is.
ExactResult searchExactly(const KernelLattice& lattice, const std::vector<int>& features,
                          std::int64_t known, std::int64_t max_work);

/// Fewest accesses of any ensemble of so many features: writes, and a pass of two reads.
constexpr std::int64_t trivialBound(std::int64_t features) { return features + 2; }

}  // namespace chain_tracker::haar
