// SPDX-License-Identifier: BSD-3-Clause
/// Wall time of one step after another.
#pragma once

#include <chrono>

namespace chain_tracker {

class Stopwatch {
 public:
  /// Time since the last lap or construction [ms].
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double, std::milli> elapsed = now - start_;
    start_ = now;
    return elapsed.count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace chain_tracker
