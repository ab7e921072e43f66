// SPDX-License-Identifier: BSD-3-Clause
/// The local search of parser.h.
#pragma once

#include <vector>

#include "kernel_forest.h"

namespace chain_tracker::haar {

/// All targets directly under the integral image, shifted so that they share reads.
/// `positions`: delays at which the features use them, another alignment to try.
KernelForest directForest(const KernelLattice& lattice, const std::vector<int>& features,
                          const std::vector<cv::Point>& positions, bool share_reads);

/// Local search from a forest of all targets; `rounds` disturbances.
KernelForest searchForest(const KernelLattice& lattice, const KernelForest& start, int rounds);

}  // namespace chain_tracker::haar
