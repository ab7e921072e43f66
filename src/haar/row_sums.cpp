// SPDX-License-Identifier: BSD-3-Clause
#include "row_sums.h"

#include <algorithm>
#include <utility>

#include "machine_instructions.h"
#include "tap_shape.h"

namespace chain_tracker::haar {
namespace {

auto loopsFor(RowKind kind, InstructionSet instructions) {
  // Rows of 32 bits are mostly read from and written to memory beyond the caches, where vectors of
  // 512 bits, which hardly ever fit a line, cost up to half as much again as those of 256.
  if (kind != RowKind::k32To32 && canUseAvx512(instructions)) return avx512Loop;
  return canUseAvx2(instructions) ? avx2Loop : portableLoop;
}

}  // namespace

RowSum::RowSum(RowKind kind, const std::vector<RowTap>& taps, InstructionSet instructions)
    : taps_(taps) {
  const TapShape shape = groupTaps(taps_);
  const auto loop = loopsFor(kind, instructions);
  sum_ = loop(kind, shape, Write::kThroughCaches);
  streaming_sum_ = loop(kind, shape, Write::kAroundCaches);
}

std::optional<RowSum> RowSum::ofSeparable(RowKind kind, const SeparableTaps& taps,
                                          InstructionSet instructions) {
  // A delay must fit in the two vectors that are at hand.
  const auto [least, most] =
      std::minmax_element(taps.row.begin(), taps.row.end(),
                          [](const RowTap& a, const RowTap& b) { return a.dx < b.dx; });
  if (!canUseAvx512(instructions) || most->dx - least->dx > kTouchedColumns / 2) {
    return std::nullopt;
  }
  SeparableTaps grouped = taps;
  const TapShape column = groupTaps(grouped.column);
  const TapShape row = groupTaps(grouped.row);
  RowSum sum;
  sum.sum_ = separableLoop(kind, column, row, Write::kThroughCaches);
  sum.streaming_sum_ = separableLoop(kind, column, row, Write::kAroundCaches);
  if (sum.sum_ == nullptr) return std::nullopt;
  sum.taps_ = std::move(grouped.column);
  sum.taps_.insert(sum.taps_.end(), grouped.row.begin(), grouped.row.end());
  return sum;
}

}  // namespace chain_tracker::haar
