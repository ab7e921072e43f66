// SPDX-License-Identifier: BSD-3-Clause
/// The tracker where time comes from a bag.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>

#include "ros/tracker_client.h"

namespace chain_tracker {
namespace {

class SimulatedTimeTest : public testing::Test {
 protected:
  SimulatedTimeTest() : client_("tracker") {}
  void SetUp() override { ASSERT_TRUE(client_.ready()); }
  void TearDown() override { client_.remove("bottle"); }

  RenderedScene scene_;
  TrackerClient client_;
};

TEST_F(SimulatedTimeTest, TimeThatStandsStillStopsNothing) {
  ASSERT_TRUE(ros::Time::isSimTime());
  EXPECT_TRUE(ros::Time::now().isZero());
  const auto refused = client_.setTarget(bottleRequest("bottle", BottlePose()), cv::Mat());
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("within 1 s"), std::string::npos) << refused.message;
  const cv::Mat image = scene_.with({BottlePose()});
  EXPECT_TRUE(client_.setTarget(bottleRequest("bottle", BottlePose()), image).success);
  EXPECT_TRUE(isAt(objectOf(client_.show(image), "bottle"), BottlePose()));
}

TEST_F(SimulatedTimeTest, DiagnosticsGoOnWhereTimeGoesBack) {
  ros::NodeHandle node;
  int reports = 0;
  const ros::Subscriber diagnostics = node.subscribe<diagnostic_msgs::DiagnosticArray>(
      "/diagnostics", 100, [&](const diagnostic_msgs::DiagnosticArray::ConstPtr&) { ++reports; });
  ros::Publisher clock = node.advertise<rosgraph_msgs::Clock>("/clock", 10);
  ASSERT_TRUE(waitUntil([&] { return clock.getNumSubscribers() >= 2; }));
  for (const double seconds : {500.0, 100.0}) {
    SCOPED_TRACE(seconds);
    rosgraph_msgs::Clock time;
    time.clock = ros::Time(seconds);
    clock.publish(time);
    const int before = reports;
    EXPECT_TRUE(waitUntil([&] { return reports >= before + 2; }));
  }
}

TEST_F(SimulatedTimeTest, StampsAreThoseOfTheBag) {
  ros::Publisher clock = ros::NodeHandle().advertise<rosgraph_msgs::Clock>("/clock", 10);
  ASSERT_TRUE(waitUntil([&] { return clock.getNumSubscribers() >= 2; }));
  const cv::Mat image = scene_.with({BottlePose()});
  for (int k = 0; k < 10; ++k) {
    const auto message = imageMsg(image, nextStamp());
    rosgraph_msgs::Clock time;
    time.clock = message->header.stamp + ros::Duration(0.01);
    clock.publish(time);
    const auto objects = client_.show(*message);
    ASSERT_TRUE(objects);
    EXPECT_EQ(objects->header.stamp, message->header.stamp);
    EXPECT_LT(objects->processing_time, ros::Duration(kDeadline));
    EXPECT_GT(objects->processing_time, ros::Duration(0.0));
  }
}

}  // namespace
}  // namespace chain_tracker

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "simulated_time_rostest");
  const ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
