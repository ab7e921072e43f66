// SPDX-License-Identifier: BSD-3-Clause
#include "cache_size.h"

#include <algorithm>
#include <fstream>
#include <string>

namespace chain_tracker::haar {
namespace {

constexpr size_t kGuess = size_t{16} << 20;

/// "32768K" of Linux; 0 if there is no such level. sysconf() is no alternative: on machines whose
/// processors share several caches it tells their sum.
size_t bytesOfLevel(int index) {
  std::ifstream file("/sys/devices/system/cpu/cpu0/cache/index" + std::to_string(index) + "/size");
  size_t size = 0;
  char unit = ' ';
  if (!(file >> size >> unit)) return 0;
  if (unit == 'K') return size << 10;
  return unit == 'M' ? size << 20 : 0;
}

size_t largestCache() {
  size_t largest = 0;
  for (int index = 0; index < 5; ++index) largest = std::max(largest, bytesOfLevel(index));
  return largest != 0 ? largest : kGuess;
}

}  // namespace

size_t lastCacheBytes() {
  static const size_t kBytes = largestCache();
  return kBytes;
}

}  // namespace chain_tracker::haar
