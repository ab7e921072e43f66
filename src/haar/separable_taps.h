// SPDX-License-Identifier: BSD-3-Clause
/// Kernels that are a column of taps times a row of taps.
#pragma once

#include <optional>

#include "chain_tracker/haar/sparse_kernel.h"
#include "row_sums.h"

namespace chain_tracker::haar {

/// Nothing if the kernel is not separable.
std::optional<SeparableTaps> separableTaps(const SparseKernel& kernel);

}  // namespace chain_tracker::haar
