// SPDX-License-Identifier: BSD-3-Clause
/// The two searches of parser.h.
#pragma once

#include <optional>
#include <vector>

#include "kernel_forest.h"

namespace chain_tracker::haar {

/// All targets directly under the integral image, shifted so that they share reads.
/// `positions`: delays at which the features use them, another alignment to try.
KernelForest directForest(const KernelLattice& lattice, const std::vector<int>& features,
                          const std::vector<cv::Point>& positions, bool share_reads);

/// Local search from a forest of all targets; `rounds` disturbances.
KernelForest searchForest(const KernelLattice& lattice, const KernelForest& start, int rounds);

/// How many combinations of chains of divisors there are; `limit` + 1 if more than limit.
std::int64_t countForests(const KernelLattice& lattice, std::int64_t limit);

struct ExactResult {
  std::optional<KernelForest> better;  ///< than the known cost, the best there is
  bool is_proven = false;              ///< nothing in the space has fewer accesses
};

/// Looks at all forests with fewer accesses than `known`.
ExactResult searchAllForests(const KernelLattice& lattice, const std::vector<int>& features,
                             std::int64_t known);

}  // namespace chain_tracker::haar
