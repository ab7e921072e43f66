// SPDX-License-Identifier: BSD-3-Clause
/// The loops of a plan's steps.
#pragma once

#include <vector>

#include "chain_tracker/haar/convolution_plan.h"
#include "row_sums.h"

namespace chain_tracker::haar {

/// Rows computed by one step before the next step follows.
constexpr int kBatchRows = 8;

RowKind rowKindOf(const PlanStep& step, const PlanBuffer& source);
std::vector<std::int32_t> weightsOf(const PlanStep& step);

}  // namespace chain_tracker::haar
