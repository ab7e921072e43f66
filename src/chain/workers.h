// SPDX-License-Identifier: BSD-3-Clause
/// Work that several threads share.
#pragma once

#include <algorithm>
#include <cstddef>

#include <opencv2/core/utility.hpp>

namespace chain_tracker {

/// How many of `threads` are worth while: to wake one takes as long as a good many of `steps`, each
/// of which visits a state of a part.
inline size_t workersFor(int threads, double steps) {
  constexpr double kStepsOfAWorker = 65536.0;
  return static_cast<size_t>(std::max(1.0, std::min<double>(threads, steps / kStepsOfAWorker)));
}

/// Calls work(0) to work(workers - 1) and returns when all are done: at once as far as OpenCV has
/// threads to spare, one after the other inside another parallel region. Wakes nobody for a single
/// one.
template <typename Work>
void onWorkers(size_t workers, const Work& work) {
  if (workers <= 1) {
    work(0);
    return;
  }
  const auto work_on = [&work](const cv::Range& range) {
    for (int worker = range.start; worker < range.end; ++worker) work(static_cast<size_t>(worker));
  };
  cv::parallel_for_({0, static_cast<int>(workers)}, work_on, static_cast<double>(workers));
}

/// Calls work(item, worker) once for each item, of which each takes as many steps; a worker, below
/// `threads`, does one item after the other.
template <typename Work>
void shareOut(int threads, size_t items, double steps, const Work& work) {
  const size_t wanted = workersFor(threads, steps * static_cast<double>(items));
  const size_t workers = std::min(wanted, items);
  onWorkers(workers, [&](size_t worker) {
    for (size_t item = worker; item < items; item += workers) work(item, worker);
  });
}

}  // namespace chain_tracker
