// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace chain_tracker {

/// Runs a program and waits for it; `command` is its path and its arguments, no shell is involved.
/// Both its outputs go to the file `log`, or where this program's go if that is empty. Once
/// `interrupted` tells so, the child is sent SIGINT as well and given the time that it takes to
/// end. Returns its exit code, 128 and the number of the signal that killed it, or -1 if it could
/// not be started.
int runChild(const std::vector<std::string>& command, const std::string& log,
             const std::function<bool()>& interrupted);

}  // namespace chain_tracker
