// SPDX-License-Identifier: BSD-3-Clause
/// The last images received, so that an object can be given in an image that has already passed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <vector>

#include <ros/time.h>

#include "chain_tracker/ros/frame_mailbox.h"

namespace chain_tracker {

/// Thread-safe. Holds the messages themselves: no copies of pixels, no conversions.
class ImageHistory {
 public:
  /// Holds at most `capacity` images.
  explicit ImageHistory(std::size_t capacity) : capacity_(capacity) {}

  /// Adds the newest frame. One of another size than the others, or of an earlier stamp (a bag that
  /// starts again), belongs to another stream: the others are forgotten.
  void add(const Frame& frame);

  /// The frame of this very stamp.
  /// Throws std::invalid_argument, naming the oldest and the newest stamp held, if there is none.
  Frame at(const ros::Time& stamp) const;

  bool holds(const ros::Time& stamp) const;

  /// Frames of numbers in (after, up_to], oldest first.
  std::vector<Frame> between(std::uint64_t after, std::uint64_t up_to) const;

 private:
  std::deque<Frame>::const_iterator find(const ros::Time& stamp) const;

  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::deque<Frame> frames_;
};

}  // namespace chain_tracker
