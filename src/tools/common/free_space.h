// SPDX-License-Identifier: BSD-3-Clause
/// Whether a disk has room for a file before it is written.
#pragma once

#include <cstdint>
#include <string>

namespace chain_tracker {

/// Throws std::invalid_argument with both numbers if `file` is to be larger than what its disk has
/// left; passes where that cannot be told.
void requireSpace(const std::string& file, std::uintmax_t bytes);

}  // namespace chain_tracker
