// SPDX-License-Identifier: BSD-3-Clause
#include "step_sum.h"

namespace chain_tracker::haar {

RowKind rowKindOf(const PlanStep& step, const PlanBuffer& source) {
  if (step.lane == Lane::k16) {
    if (step.target >= 0) return RowKind::k16To16;
    return step.is_signed ? RowKind::k16To32Signed : RowKind::k16To32Unsigned;
  }
  if (source.lane == Lane::k32) return RowKind::k32To32;
  return source.is_signed ? RowKind::kSigned16To32 : RowKind::kUnsigned16To32;
}

std::vector<std::int32_t> weightsOf(const PlanStep& step) {
  std::vector<std::int32_t> weights;
  for (const PlanInput& input : step.inputs) weights.push_back(input.weight);
  return weights;
}

}  // namespace chain_tracker::haar
