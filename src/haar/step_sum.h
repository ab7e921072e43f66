// SPDX-License-Identifier: BSD-3-Clause
/// The loops of a plan's steps.
#pragma once

#include <vector>

#include "chain_tracker/haar/convolution_plan.h"
#include "row_sums.h"

namespace chain_tracker::haar {

/// Rows computed by one step before the next step follows.
constexpr int kBatchRows = 2;

/// How many of so many planes of 32-bit responses are written through the caches. The others are
/// written around them: all, if the caches would keep none until they are written again.
size_t cachedPlanes(const cv::Size& size, size_t planes);

RowKind rowKindOf(const PlanStep& step, const PlanBuffer& source);
std::vector<RowTap> tapsOf(const PlanStep& step);

}  // namespace chain_tracker::haar
