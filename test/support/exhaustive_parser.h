// SPDX-License-Identifier: BSD-3-Clause
/// The parser's whole space, looked at without the parser's searches, for small ensembles.
#pragma once

#include <cstdint>
#include <limits>

#include "chain_tracker/haar/haar_feature.h"

namespace chain_tracker::exhaustive {

/// Accesses of the cheapest of all trees: every way of every feature up to the integral image, and
/// for every pass every way to shift its kernels so that they meet. Trees that need more than
/// `at_most` before all features are in them are left: adding a feature takes nothing away. More
/// than `at_most` if no tree does with that many. Exponential in everything.
std::int64_t fewestAccesses(const haar::FeatureEnsemble& ensemble,
                            std::int64_t at_most = std::numeric_limits<std::int64_t>::max() - 1);

}  // namespace chain_tracker::exhaustive
