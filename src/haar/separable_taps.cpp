// SPDX-License-Identifier: BSD-3-Clause
#include "separable_taps.h"

#include <numeric>

namespace chain_tracker::haar {
namespace {

/// The first row that has taps, put into row 0; its first weight is positive, and its weights have
/// no common divisor.
SparseKernel firstRow(const SparseKernel& kernel) {
  std::int64_t divisor = kernel.taps().front().weight;
  std::vector<KernelTap> row;
  for (const KernelTap& tap : kernel.taps()) {
    if (tap.dy != kernel.taps().front().dy) break;
    divisor = std::gcd(divisor, tap.weight);
    row.push_back({0, tap.dx, tap.weight});
  }
  if (row.front().weight < 0) divisor = -divisor;
  for (KernelTap& tap : row) tap.weight /= divisor;
  return SparseKernel(row);
}

std::vector<RowTap> rowTaps(const SparseKernel& kernel) {
  std::vector<RowTap> taps;
  for (const KernelTap& tap : kernel.taps()) {
    taps.push_back({tap.dx, tap.dy, static_cast<std::int32_t>(tap.weight)});
  }
  return taps;
}

}  // namespace

std::optional<SeparableTaps> separableTaps(const SparseKernel& kernel) {
  if (kernel.isZero()) return std::nullopt;
  const SparseKernel row = firstRow(kernel);
  const std::optional<SparseKernel> column = kernel.dividedBy(row);
  if (!column || column->minDelay().x != 0 || column->maxDelay().x != 0) return std::nullopt;
  return SeparableTaps{rowTaps(*column), rowTaps(row)};
}

}  // namespace chain_tracker::haar
