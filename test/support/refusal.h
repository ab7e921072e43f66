// SPDX-License-Identifier: BSD-3-Clause
/// Checks of errors: what is refused, and whether the reason says enough.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace chain_tracker {

/// The reason of the std::invalid_argument that `action` throws; empty if it throws nothing. Other
/// exceptions pass.
std::string refusalOf(const std::function<void()>& action);

/// Empty if the refusal contains all the texts; otherwise what it says and what it leaves out.
/// An empty refusal, which is none, leaves out everything.
std::string omissionsOf(const std::string& refusal, const std::vector<std::string>& texts);

}  // namespace chain_tracker
