// SPDX-License-Identifier: BSD-3-Clause
#include "machine_name.h"

#include <fstream>

#include "cache_size.h"
#include "machine_instructions.h"

namespace chain_tracker::haar {
namespace {

/// The first processor's name and numbers, of Linux; empty elsewhere.
std::string processorName() {
  std::ifstream file("/proc/cpuinfo");
  std::string name;
  for (std::string line; std::getline(file, line) && !line.empty();) {
    for (const char* key : {"cpu family\t", "model\t", "model name\t", "stepping\t"}) {
      if (line.rfind(key, 0) == 0) name += line.substr(line.find(':') + 1);
    }
  }
  return name;
}

const char* instructionsName() {
  if (canUseAvx512(InstructionSet::kBest)) return "AVX-512";
  return canUseAvx2(InstructionSet::kBest) ? "AVX2" : "portable";
}

}  // namespace

std::string machineName() {
  return "processor" + processorName() + ", cache " + std::to_string(lastCacheBytes()) + ", " +
         instructionsName() + ", loops " + CHAIN_TRACKER_LOOPS_VERSION;
}

}  // namespace chain_tracker::haar
