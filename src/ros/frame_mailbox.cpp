// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/ros/frame_mailbox.h"

#include <utility>

namespace chain_tracker {

void FrameMailbox::put(Frame frame) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (frame_) ++drops_;
    frame_ = std::move(frame);
  }
  changed_.notify_one();
}

std::optional<Frame> FrameMailbox::take() {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return frame_ || closed_; });
  if (closed_) return std::nullopt;
  return std::exchange(frame_, std::nullopt);
}

void FrameMailbox::close() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

std::uint64_t FrameMailbox::drops() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return drops_;
}

}  // namespace chain_tracker
