// SPDX-License-Identifier: BSD-3-Clause
/// Several trackers in one nodelet manager.
#include <chrono>
#include <future>

#include <gtest/gtest.h>
#include <nodelet/NodeletUnload.h>
#include <ros/ros.h>

#include "ros/tracker_client.h"

namespace chain_tracker {
namespace {

class InstancesTest : public testing::Test {
 protected:
  InstancesTest() : left_("left", "left_camera/image"), right_("right", "right_camera/image") {}
  void SetUp() override {
    ASSERT_TRUE(left_.ready());
    ASSERT_TRUE(right_.ready());
  }

  RenderedScene scene_;
  TrackerClient left_;
  TrackerClient right_;
};

TEST_F(InstancesTest, DoNotKnowOfEachOther) {
  const BottlePose left_pose;
  BottlePose right_pose;
  right_pose.centre.x += 60.0;
  const cv::Mat left_image = scene_.with({left_pose});
  const cv::Mat right_image = scene_.with({right_pose});
  ASSERT_TRUE(left_.setTarget(bottleRequest("", left_pose), left_image).success);
  ASSERT_TRUE(right_.setTarget(bottleRequest("", right_pose), right_image).success);
  const std::size_t left_count = left_.received().size();
  for (int k = 0; k < 5; ++k) {
    const auto objects = right_.show(right_image);
    ASSERT_TRUE(objects);
    ASSERT_EQ(objects->objects.size(), 1u);
    EXPECT_TRUE(isAt(objectOf(objects, "right_hand"), right_pose));
  }
  EXPECT_EQ(left_.received().size(), left_count);
  EXPECT_TRUE(isAt(objectOf(left_.show(left_image), "target"), left_pose));
}

/// Last, as it ends one of the trackers.
TEST_F(InstancesTest, OneIsUnloadedAtOnceWhileACommandOfItWaits) {
  auto waiting = std::async(std::launch::async, [] {
    SetTarget service;
    service.request = bottleRequest("late", BottlePose());
    return ros::service::call("left/set_target", service) && service.response.success;
  });
  ASSERT_FALSE(waitUntil(
      [&] { return waiting.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }, 0.5));
  auto unloading = std::async(std::launch::async, [] {
    nodelet::NodeletUnload service;
    service.request.name = ros::names::resolve("left");
    return ros::service::call("manager/unload_nodelet", service) && service.response.success;
  });
  ASSERT_TRUE(waitUntil(
      [&] { return unloading.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }));
  EXPECT_TRUE(unloading.get());
  ASSERT_TRUE(waitUntil(
      [&] { return waiting.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }));
  EXPECT_FALSE(waiting.get());
  EXPECT_TRUE(right_.show(scene_.wall())) << "the other tracker has stopped";
}

}  // namespace
}  // namespace chain_tracker

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "instances_rostest");
  const ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
