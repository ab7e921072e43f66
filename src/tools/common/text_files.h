// SPDX-License-Identifier: BSD-3-Clause
/// Text files that are written as a whole or refused: a full disk tells so no sooner than when a
/// file is closed.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace chain_tracker {

/// Throws std::runtime_error naming the file if it cannot be written.
void writeText(const std::string& path, const std::string& content);

/// Bytes that are no UTF-8, which names of files may hold, become U+FFFD. Throws as above.
void writeJson(const std::string& path, const nlohmann::json& content);

}  // namespace chain_tracker
