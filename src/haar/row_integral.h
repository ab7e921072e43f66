// SPDX-License-Identifier: BSD-3-Clause
/// Rows of an integral image, modulo the size of its elements.
#pragma once

#include <cstdint>

#include "chain_tracker/haar/instruction_set.h"

namespace chain_tracker::haar {

/// integral[x] = above[x] + before + pixels[0] + .. + pixels[x]. Returns the sum of `before` and
/// all pixels, for the piece to the right.
std::uint16_t integrateRow(const std::uint8_t* pixels, const std::uint16_t* above,
                           std::uint16_t before, std::uint16_t* integral, int count,
                           InstructionSet instructions);
std::uint32_t integrateRow(const std::uint8_t* pixels, const std::uint32_t* above,
                           std::uint32_t before, std::uint32_t* integral, int count,
                           InstructionSet instructions);

}  // namespace chain_tracker::haar
