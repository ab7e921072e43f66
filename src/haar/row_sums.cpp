// SPDX-License-Identifier: BSD-3-Clause
#include "row_sums.h"

#include "tap_shape.h"

namespace chain_tracker::haar {
namespace {

bool isWide(InstructionSet instructions) {
#if defined(__x86_64__) && defined(__GNUC__)
  return instructions == InstructionSet::kBest && __builtin_cpu_supports("avx2") != 0;
#else
  static_cast<void>(instructions);
  return false;
#endif
}

}  // namespace

RowSum::RowSum(RowKind kind, const std::vector<RowTap>& taps, InstructionSet instructions)
    : taps_(taps) {
  const TapShape shape = groupTaps(taps_);
  const auto loop = isWide(instructions) ? wideLoop : portableLoop;
  sum_ = loop(kind, shape, Write::kThroughCaches);
  streaming_sum_ = loop(kind, shape, Write::kAroundCaches);
}

}  // namespace chain_tracker::haar
