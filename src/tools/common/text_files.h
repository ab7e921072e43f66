// SPDX-License-Identifier: BSD-3-Clause
/// Text files that are written as a whole or refused: a full disk tells so no sooner than when a
/// file is closed.
#pragma once

#include <string>

namespace chain_tracker {

/// Throws std::runtime_error naming the file if it cannot be written.
void writeText(const std::string& path, const std::string& content);

}  // namespace chain_tracker
