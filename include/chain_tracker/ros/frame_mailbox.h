// SPDX-License-Identifier: BSD-3-Clause
/// Hands frames from the subscriber to the worker: one place, the latest frame wins.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>

#include <sensor_msgs/Image.h>

namespace chain_tracker {

struct Frame {
  std::uint64_t number = 0;  ///< running number of the frames received, from 1
  sensor_msgs::ImageConstPtr image;
};

/// Thread-safe.
class FrameMailbox {
 public:
  /// Replaces the frame that waits, if any; that one is dropped and counted. Never blocks.
  void put(Frame frame);

  /// Takes the frame that waits; blocks until there is one. Nothing once the mailbox is closed.
  std::optional<Frame> take();

  /// Ends all waiting, for good.
  void close();

  /// Number of frames that were replaced before anyone took them.
  std::uint64_t drops() const;

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Frame> frame_;
  std::uint64_t drops_ = 0;
  bool closed_ = false;
};

}  // namespace chain_tracker
