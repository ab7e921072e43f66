// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "chain_tracker/chain/chain_state.h"

namespace chain_tracker {

/// All of a state but its times, every number to its last bit: equal texts are equal states.
std::string textOf(const ChainState& state);

}  // namespace chain_tracker
