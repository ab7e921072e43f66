// SPDX-License-Identifier: BSD-3-Clause
#include "machine_instructions.h"

namespace chain_tracker::haar {

#if defined(__x86_64__) && defined(__GNUC__)
bool canUseAvx512(InstructionSet allowed) {
  return allowed == InstructionSet::kBest && __builtin_cpu_supports("avx512bw") != 0;
}

bool canUseAvx2(InstructionSet allowed) {
  return allowed != InstructionSet::kPortable && __builtin_cpu_supports("avx2") != 0;
}
#else
bool canUseAvx512(InstructionSet) { return false; }
bool canUseAvx2(InstructionSet) { return false; }
#endif

}  // namespace chain_tracker::haar
