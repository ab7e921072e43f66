// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace chain_tracker::haar {

/// Which instructions the inner loops use; the results are the same.
enum class InstructionSet {
  kBest,     ///< the widest that the machine has
  kAvx2,     ///< the same, but none wider than AVX2
  kPortable  ///< what the package is compiled for
};

}  // namespace chain_tracker::haar
