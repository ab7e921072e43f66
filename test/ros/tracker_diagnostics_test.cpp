// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/ros/tracker_diagnostics.h"

#include <string>

#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;

TrackedObjectArray oneObject(std::uint8_t state) {
  TrackedObjectArray array;
  array.objects.resize(1);
  array.objects[0].id = "cup";
  array.objects[0].state = state;
  array.objects[0].confidence = 0.5f;
  return array;
}

DiagnosticStatusWrapper reportOf(TrackerDiagnostics* diagnostics, std::uint64_t drops = 0,
                                 bool is_paused = false) {
  DiagnosticStatusWrapper status;
  diagnostics->report(drops, is_paused, &status);
  return status;
}

std::string valueOf(const DiagnosticStatusWrapper& status, const std::string& key) {
  for (const auto& pair : status.values) {
    if (pair.key == key) return pair.value;
  }
  return "missing";
}

TEST(TrackerDiagnostics, WarnsWhereNoImageComes) {
  TrackerDiagnostics diagnostics;
  EXPECT_EQ(reportOf(&diagnostics).level, DiagnosticStatus::WARN);
  diagnostics.record(oneObject(TrackedObject::TRACKING), ros::Duration(0.02));
  EXPECT_EQ(reportOf(&diagnostics).level, DiagnosticStatus::OK);
  EXPECT_EQ(reportOf(&diagnostics).message, "no images");
}

TEST(TrackerDiagnostics, DoesNotMissImagesWhilePaused) {
  TrackerDiagnostics diagnostics;
  const DiagnosticStatusWrapper status = reportOf(&diagnostics, 0, true);
  EXPECT_EQ(status.level, DiagnosticStatus::OK);
  EXPECT_EQ(status.message, "paused");
}

TEST(TrackerDiagnostics, TellsOfImagesThatCannotBeRead) {
  TrackerDiagnostics diagnostics;
  diagnostics.recordUnreadable("encoding '32FC1'");
  diagnostics.recordUnreadable("encoding '32FC1'");
  const DiagnosticStatusWrapper status = reportOf(&diagnostics);
  EXPECT_EQ(status.level, DiagnosticStatus::ERROR);
  EXPECT_NE(status.message.find("32FC1"), std::string::npos);
  EXPECT_EQ(valueOf(status, "Unreadable frames"), "2");
  EXPECT_EQ(reportOf(&diagnostics).message, "no images");
  diagnostics.recordUnreadable("empty");
  diagnostics.record(oneObject(TrackedObject::TRACKING), ros::Duration(0.02));
  EXPECT_EQ(reportOf(&diagnostics).level, DiagnosticStatus::WARN) << "one among others";
}

TEST(TrackerDiagnostics, WarnsOfALostObjectByItsName) {
  TrackerDiagnostics diagnostics;
  diagnostics.record(oneObject(TrackedObject::LOST), ros::Duration(0.02));
  const DiagnosticStatusWrapper status = reportOf(&diagnostics);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_NE(status.message.find("'cup'"), std::string::npos);
}

TEST(TrackerDiagnostics, TellsLatencyDropsAndConfidence) {
  TrackerDiagnostics diagnostics;
  diagnostics.record(oneObject(TrackedObject::TRACKING), ros::Duration(0.02));
  const DiagnosticStatusWrapper status = reportOf(&diagnostics, 3);
  EXPECT_EQ(valueOf(status, "Latency [ms]"), "20.0");
  EXPECT_EQ(valueOf(status, "Dropped frames"), "3");
  EXPECT_EQ(valueOf(status, "Confidence of cup"), "0.50");
  EXPECT_NE(valueOf(status, "Rate [Hz]"), "missing");
  EXPECT_EQ(valueOf(reportOf(&diagnostics, 5), "Dropped frames"), "2");
}

}  // namespace
}  // namespace chain_tracker
