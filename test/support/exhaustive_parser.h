// SPDX-License-Identifier: BSD-3-Clause
/// The parser's whole space without its bounds and memories, for tiny ensembles.
#pragma once

#include <cstdint>

#include "chain_tracker/haar/haar_feature.h"

namespace chain_tracker::exhaustive {

/// Accesses of the cheapest of all trees: every combination of chains of divisors, and for every
/// pass every way to shift its kernels so that they meet. Exponential in everything.
std::int64_t fewestAccesses(const haar::FeatureEnsemble& ensemble);

}  // namespace chain_tracker::exhaustive
