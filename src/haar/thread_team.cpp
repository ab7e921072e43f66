// SPDX-License-Identifier: BSD-3-Clause
#include "thread_team.h"

#include <utility>

namespace chain_tracker::haar {

ThreadTeam::ThreadTeam(int members, Work work) : work_(std::move(work)) {
  try {
    for (int member = 1; member < members; ++member) {
      threads_.emplace_back([this, member] { serve(member); });
    }
  } catch (...) {
    // The system has no more of them: those that wait already must not be left behind.
    stop();
    throw;
  }
}

ThreadTeam::~ThreadTeam() { stop(); }

void ThreadTeam::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  started_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadTeam::run() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++round_;
    working_ = static_cast<int>(threads_.size());
  }
  started_.notify_all();
  work_(0);
  std::unique_lock<std::mutex> lock(mutex_);
  finished_.wait(lock, [this] { return working_ == 0; });
}

void ThreadTeam::serve(int member) {
  int last_round = 0;
  for (;;) {
    {
      std::unique_lock<std::mutex> lock(mutex_);
      started_.wait(lock, [&] { return stopping_ || round_ != last_round; });
      if (stopping_) return;
      last_round = round_;
    }
    work_(member);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      --working_;
    }
    finished_.notify_one();
  }
}

}  // namespace chain_tracker::haar
