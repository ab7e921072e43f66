// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace chain_tracker::haar {

/// Of the last level that the first processor reaches [bytes]; a cautious guess where the system
/// does not tell. Known once it was asked for.
size_t lastCacheBytes();

}  // namespace chain_tracker::haar
