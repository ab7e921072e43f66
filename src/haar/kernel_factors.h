// SPDX-License-Identifier: BSD-3-Clause
/// Kernels as products of smaller kernels. The rules are those of parser.h.
#pragma once

#include <set>
#include <vector>

#include "chain_tracker/haar/sparse_kernel.h"

namespace chain_tracker::haar {

/// Delays n of the factors 1 - X^n and 1 - Y^n that occur in an ensemble.
struct DifferenceDelays {
  std::set<int> x;
  std::set<int> y;
};

/// The longest differences that divide the kernel, of all its factors.
DifferenceDelays differenceDelays(const SparseKernel& kernel);

/// Factors of a primitive kernel, whose product it is, with repetitions; differences are split
/// further where the ensemble has a half or a third of their delay.
std::vector<SparseKernel> factorsOf(const SparseKernel& kernel, const DifferenceDelays& delays);

/// Most products of factors of one kernel that are looked at; a kernel that has more is split less.
constexpr size_t kMaxProducts = 4096;

/// Products of some of the factors that have no more taps than the kernel, and leave no more taps
/// than it has; without 1 and the kernel itself; sorted.
std::vector<SparseKernel> properDivisors(const SparseKernel& kernel,
                                         const DifferenceDelays& delays);

}  // namespace chain_tracker::haar
