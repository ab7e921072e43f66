// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "chain_tracker/chain/chain_model.h"

namespace chain_tracker {

/// Empty if both models are equal in everything; otherwise each key that differs, with both values.
std::string differencesOf(const ChainModel& expected, const ChainModel& actual);

}  // namespace chain_tracker
