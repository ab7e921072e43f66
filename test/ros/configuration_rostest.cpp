// SPDX-License-Identifier: BSD-3-Clause
/// Trackers whose parameters give objects, or are wrong.
#include <string>

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <roscpp/GetLoggers.h>

#include "ros/tracker_client.h"

namespace chain_tracker {
namespace {

const RenderedScene& scene() {
  static const RenderedScene kScene;
  return kScene;
}

bool isAlive(const std::string& node) {
  roscpp::GetLoggers service;
  return ros::service::call(node + "/get_loggers", service);
}

/// All nodes hear the same images: the tests show the same picture all the time.
/// "listed" and "text" listen to the same images; the faulty ones are idle.
constexpr std::uint32_t kListeners = 2;

TEST(Configuration, FaultyObjectsOfTheListDoNotTouchTheGoodOne) {
  TrackerClient client("listed", "image", kListeners);
  ASSERT_TRUE(client.ready());
  for (int k = 0; k < 3; ++k) {
    const auto objects = client.show(scene().with({BottlePose()}));
    ASSERT_TRUE(objects);
    ASSERT_EQ(objects->objects.size(), 1u);
    EXPECT_TRUE(isAt(objectOf(objects, "good"), BottlePose()));
  }
}

TEST(Configuration, PointsAsTextGiveAnObject) {
  TrackerClient client("text", "image", kListeners);
  ASSERT_TRUE(client.ready());
  const auto object = objectOf(client.show(scene().with({BottlePose()})), "hose");
  ASSERT_TRUE(object);
  EXPECT_EQ(object->model, "cable");
}

TEST(Configuration, AFaultyParameterLeavesTheNodeAliveAndIdle) {
  for (const std::string node : {"faulty", "no_transport", "no_model"}) {
    SCOPED_TRACE(node);
    ASSERT_TRUE(ros::service::waitForService(node + "/get_loggers", ros::Duration(kDeadline)));
    TrackerClient others("text", "image", kListeners);
    ASSERT_TRUE(others.ready());
    for (int k = 0; k < 3; ++k) ASSERT_TRUE(others.show(scene().with({BottlePose()})));
    EXPECT_TRUE(isAlive(node));
    EXPECT_FALSE(ros::service::exists(node + "/set_target", false));
  }
}

}  // namespace
}  // namespace chain_tracker

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "configuration_rostest");
  const ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
