// SPDX-License-Identifier: BSD-3-Clause
/// What measurements of loops hold for.
#pragma once

#include <string>

namespace chain_tracker::haar {

/// The processor, its cache and widest vectors, and the build of the loops.
std::string machineName();

}  // namespace chain_tracker::haar
