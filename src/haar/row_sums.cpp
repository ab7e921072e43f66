// SPDX-License-Identifier: BSD-3-Clause
#include "row_sums.h"

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

}  // namespace chain_tracker::haar
