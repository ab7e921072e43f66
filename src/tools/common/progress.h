// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace chain_tracker {

/// Tells on standard error how far a run has come: a bar with rate and remaining time on a
/// terminal, a line for every tenth elsewhere. Without a total, counts frames only.
class Progress {
 public:
  explicit Progress(int total);
  void report(int done);
  void finish();

 private:
  int total_;
  bool terminal_;
  int next_tenth_ = 1;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point last_drawn_;
};

}  // namespace chain_tracker
