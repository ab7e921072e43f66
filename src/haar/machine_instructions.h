// SPDX-License-Identifier: BSD-3-Clause
/// Which vectors this machine has.
#pragma once

#include "chain_tracker/haar/instruction_set.h"

namespace chain_tracker::haar {

/// Vectors of 512 bits with instructions for bytes and words.
bool canUseAvx512(InstructionSet allowed);
bool canUseAvx2(InstructionSet allowed);

}  // namespace chain_tracker::haar
