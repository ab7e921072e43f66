// SPDX-License-Identifier: BSD-3-Clause
/// What /diagnostics tells: rate, latency, dropped frames, state and confidence of every object.
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <ros/duration.h>

#include "chain_tracker/TrackedObjectArray.h"

namespace chain_tracker {

/// Thread-safe.
class TrackerDiagnostics {
 public:
  /// Notes what was published; `latency` is the age of the image at that time.
  void record(const TrackedObjectArray& objects, const ros::Duration& latency);

  /// Notes an image that could not be read, and why.
  void recordUnreadable(const std::string& reason);

  /// Reports since the last report. A warning if no image came though the tracker is not paused, an
  /// object is LOST or an image could not be read; an error if images came and none could.
  void report(std::uint64_t drops, bool is_paused,
              diagnostic_updater::DiagnosticStatusWrapper* status);

 private:
  using Clock = std::chrono::steady_clock;

  std::mutex mutex_;
  TrackedObjectArray last_objects_;
  ros::Duration last_latency_;
  int frames_ = 0;
  int unreadable_frames_ = 0;
  std::string unreadable_reason_;
  std::uint64_t last_drops_ = 0;
  Clock::time_point last_report_ = Clock::now();
};

}  // namespace chain_tracker
