// SPDX-License-Identifier: BSD-3-Clause
#include "progress.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include <unistd.h>

namespace chain_tracker {
namespace {

constexpr int kBarWidth = 30;
constexpr double kRedrawSeconds = 0.1;

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Progress::Progress(int total)
    : total_(total),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()),
      last_drawn_(start_) {}

void Progress::report(int done) {
  const double rate = done / std::max(secondsSince(start_), 1e-6);
  if (terminal_) {
    if (secondsSince(last_drawn_) < kRedrawSeconds && done != total_) return;
    last_drawn_ = std::chrono::steady_clock::now();
    const double share = total_ > 0 ? std::min(1.0, double(done) / total_) : 0.0;
    const auto filled = static_cast<std::size_t>(share * kBarWidth);
    const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
    std::fprintf(stderr, "\r[%s] %d/%d frames, %.0f fps, %.0f s left ", bar.c_str(), done, total_,
                 rate, std::max(0, total_ - done) / rate);
  } else if (total_ > 0 && done * 10 >= next_tenth_ * total_) {
    std::fprintf(stderr, "%d %% of %d frames, %.0f fps\n", 100 * done / total_, total_, rate);
    next_tenth_ = 10 * done / total_ + 1;
  }
}

void Progress::finish() {
  if (terminal_) std::fprintf(stderr, "\n");
}

}  // namespace chain_tracker
