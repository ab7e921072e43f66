// SPDX-License-Identifier: BSD-3-Clause
/// Threads that wait for work and do it together, without allocating.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace chain_tracker::haar {

class ThreadTeam {
 public:
  using Work = std::function<void(int member)>;

  /// `work` is what each member does in every run; member 0 is the caller of run(). Throws
  /// std::system_error if the system has no thread for one of them.
  ThreadTeam(int members, Work work);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  /// Returns when all members are done.
  void run();

 private:
  void stop();
  void serve(int member);

  Work work_;
  std::mutex mutex_;
  std::condition_variable started_;
  std::condition_variable finished_;
  int round_ = 0;
  int working_ = 0;
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace chain_tracker::haar
