// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/ros/tracker_diagnostics.h"

#include <algorithm>
#include <string>

#include "chain_tracker/ros/msg_conversion.h"

namespace chain_tracker {

using diagnostic_msgs::DiagnosticStatus;

void TrackerDiagnostics::record(const TrackedObjectArray& objects, const ros::Duration& latency) {
  const std::lock_guard<std::mutex> lock(mutex_);
  last_objects_ = objects;
  // The clock of a bag may lag behind the stamps of its images.
  last_latency_ = std::max(latency, ros::Duration());
  ++frames_;
}

void TrackerDiagnostics::recordUnreadable(const std::string& reason) {
  const std::lock_guard<std::mutex> lock(mutex_);
  unreadable_reason_ = reason;
  ++unreadable_frames_;
}

void TrackerDiagnostics::report(std::uint64_t drops, bool is_paused,
                                diagnostic_updater::DiagnosticStatusWrapper* status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const Clock::time_point now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - last_report_).count();
  std::string lost;
  for (const TrackedObject& object : last_objects_.objects) {
    if (object.state == TrackedObject::LOST) lost += " '" + object.id + "'";
  }
  if (unreadable_frames_ > 0) {
    const auto level = frames_ == 0 ? DiagnosticStatus::ERROR : DiagnosticStatus::WARN;
    status->summary(level, "unreadable images: " + unreadable_reason_);
  } else if (frames_ == 0 && is_paused) {
    status->summary(DiagnosticStatus::OK, "paused");
  } else if (frames_ == 0) {
    status->summary(DiagnosticStatus::WARN, "no images");
  } else if (!lost.empty()) {
    status->summary(DiagnosticStatus::WARN, "lost:" + lost);
  } else {
    status->summary(DiagnosticStatus::OK, "tracking");
  }
  status->addf("Rate [Hz]", "%.1f", seconds > 0.0 ? frames_ / seconds : 0.0);
  status->addf("Latency [ms]", "%.1f", 1e3 * last_latency_.toSec());
  status->addf("Processing time [ms]", "%.1f", 1e3 * last_objects_.processing_time.toSec());
  status->add("Dropped frames", drops - last_drops_);
  status->add("Unreadable frames", unreadable_frames_);
  for (const TrackedObject& object : last_objects_.objects) {
    status->add("State of " + object.id, stateName(object.state));
    status->addf("Confidence of " + object.id, "%.2f", object.confidence);
  }
  frames_ = 0;
  unreadable_frames_ = 0;
  last_drops_ = drops;
  last_report_ = now;
}

}  // namespace chain_tracker
