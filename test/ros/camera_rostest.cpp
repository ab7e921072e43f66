// SPDX-License-Identifier: BSD-3-Clause
/// The launch file for a camera, whose driver is another package.
#include <gtest/gtest.h>
#include <ros/ros.h>

#include "ros/tracker_client.h"

namespace chain_tracker {
namespace {

TEST(CameraLaunch, TracksWhatTheCameraShows) {
  ros::NodeHandle node;
  TrackedObjectArray last;
  const ros::Subscriber objects = node.subscribe<TrackedObjectArray>(
      "chain_tracker/objects", 100,
      [&](const TrackedObjectArray::ConstPtr& message) { last = *message; });
  ASSERT_TRUE(waitUntil(
      [&] { return !last.objects.empty() && last.objects[0].state == TrackedObject::TRACKING; }));
  EXPECT_EQ(last.header.frame_id, "camera");
  EXPECT_EQ(last.objects[0].id, "target");
  EXPECT_EQ(last.objects[0].points.size(), 2u);
}

}  // namespace
}  // namespace chain_tracker

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "camera_rostest");
  const ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
