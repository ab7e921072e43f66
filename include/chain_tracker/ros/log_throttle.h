// SPDX-License-Identifier: BSD-3-Clause
/// Lets a message of one kind through at most once in a while.
#pragma once

#include <chrono>
#include <map>
#include <string>

namespace chain_tracker {

/// For one instance and by kind, on wall time: the throttled macros of rosconsole share one clock
/// between all instances in a process, and stand still with simulated time. Not thread-safe.
class LogThrottle {
 public:
  using Clock = std::chrono::steady_clock;

  explicit LogThrottle(Clock::duration period) : period_(period) {}

  /// Whether a message of this kind may pass now.
  bool passes(const std::string& kind, Clock::time_point now = Clock::now()) {
    const auto last = last_.find(kind);
    if (last != last_.end() && now - last->second < period_) return false;
    last_[kind] = now;
    return true;
  }

 private:
  Clock::duration period_;
  std::map<std::string, Clock::time_point> last_;
};

}  // namespace chain_tracker
