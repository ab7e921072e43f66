// SPDX-License-Identifier: BSD-3-Clause
/// The tracker as a running node: what it publishes for every image.
#include <cmath>
#include <string>
#include <vector>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <visualization_msgs/MarkerArray.h>

#include "ros/tracker_client.h"

namespace chain_tracker {
namespace {

class TrackingTest : public testing::Test {
 protected:
  TrackingTest() : client_("tracker") {}
  void SetUp() override { ASSERT_TRUE(client_.ready()); }
  void TearDown() override { client_.remove("bottle"); }

  void startBottle(const BottlePose& pose) {
    const auto answer = client_.setTarget(bottleRequest("bottle", pose), scene_.with({pose}));
    ASSERT_TRUE(answer.success) << answer.message;
  }

  std::optional<TrackedObject> showBottle(const BottlePose& pose) {
    return objectOf(client_.show(scene_.with({pose})), "bottle");
  }

  RenderedScene scene_;
  TrackerClient client_;
};

TEST_F(TrackingTest, PublishesOneMessageForEveryImageWithItsHeader) {
  const std::size_t before = client_.received().size();
  const int images = 20;
  for (int k = 0; k < images; ++k) {
    const std::string frame_id = "camera_" + std::to_string(k);
    const auto image = imageMsg(scene_.wall(), nextStamp() + ros::Duration(0, 7), "bgr8", frame_id);
    const auto objects = client_.show(*image);
    ASSERT_TRUE(objects) << "no message for image " << k;
    EXPECT_EQ(objects->header.stamp, image->header.stamp);
    EXPECT_EQ(objects->header.frame_id, frame_id);
    EXPECT_TRUE(objects->objects.empty());
    EXPECT_GT(objects->processing_time, ros::Duration(0.0));
    EXPECT_LT(objects->processing_time, ros::Duration(kDeadline));
  }
  // A second message for an image would come within this time.
  waitUntil([] { return false; }, 0.3);
  EXPECT_EQ(client_.received().size() - before, static_cast<std::size_t>(images));
}

TEST_F(TrackingTest, FollowsTheBottle) {
  BottlePose pose;
  startBottle(pose);
  for (int k = 0; k < 15; ++k) {
    pose.centre += cv::Point2d(4.0, 1.0);
    pose.angle += 0.03;
    EXPECT_TRUE(isAt(showBottle(pose), pose)) << "image " << k;
  }
  const auto object = showBottle(pose);
  ASSERT_TRUE(object);
  EXPECT_EQ(object->state, TrackedObject::TRACKING);
  EXPECT_EQ(object->model, "bottle");
  const std::vector<cv::Point2d> ends = RenderedScene::endsOf(pose);
  ASSERT_EQ(object->points.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(object->points[i].x, ends[i].x, 8.0);
    EXPECT_NEAR(object->points[i].y, ends[i].y, 8.0);
  }
}

TEST_F(TrackingTest, SaysLostWhileTheBottleIsGoneAndFindsItAgain) {
  const BottlePose pose;
  startBottle(pose);
  std::optional<TrackedObject> object;
  ASSERT_TRUE(waitUntil([&] {
    object = objectOf(client_.show(scene_.wall()), "bottle");
    return object && object->state == TrackedObject::LOST;
  })) << "an object that is not there is not lost";
  EXPECT_TRUE(std::isnan(object->pose.x));
  EXPECT_TRUE(object->outline.points.empty());
  EXPECT_EQ(object->roi.width, 0u);
  EXPECT_LT(object->confidence, 0.5f);
  object = objectOf(client_.show(scene_.wall()), "bottle");
  ASSERT_TRUE(object) << "a lost object must be told of";
  EXPECT_EQ(object->state, TrackedObject::LOST);
  EXPECT_TRUE(waitUntil([&] { return bool(isAt(showBottle(pose), pose)); }));
}

TEST_F(TrackingTest, OverlayAndMarkersHaveTheImagesHeader) {
  startBottle(BottlePose());
  std::vector<sensor_msgs::Image> overlays;
  std::vector<visualization_msgs::MarkerArray> markers;
  ros::NodeHandle node;
  const ros::Subscriber overlay_subscriber = node.subscribe<sensor_msgs::Image>(
      "tracker/overlay", 10,
      [&](const sensor_msgs::ImageConstPtr& image) { overlays.push_back(*image); });
  const ros::Subscriber marker_subscriber = node.subscribe<visualization_msgs::MarkerArray>(
      "tracker/markers", 10,
      [&](const visualization_msgs::MarkerArrayConstPtr& array) { markers.push_back(*array); });
  ASSERT_TRUE(waitUntil([&] {
    return overlay_subscriber.getNumPublishers() > 0 && marker_subscriber.getNumPublishers() > 0;
  }));
  // The tracker may learn of its listeners a little later than they do.
  sensor_msgs::Image image;
  ASSERT_TRUE(waitUntil([&] {
    image = *imageMsg(scene_.with({BottlePose()}), nextStamp(), "bgr8", "eye");
    overlays.clear();
    markers.clear();
    client_.show(image);
    return waitUntil([&] { return !overlays.empty() && !markers.empty(); }, 0.5);
  }));
  EXPECT_EQ(overlays[0].header.stamp, image.header.stamp);
  EXPECT_EQ(overlays[0].header.frame_id, "eye");
  EXPECT_EQ(overlays[0].encoding, "bgr8");
  EXPECT_EQ(overlays[0].width, image.width);
  EXPECT_NE(overlays[0].data, image.data);
  ASSERT_GT(markers[0].markers.size(), 1u);
  for (const auto& marker : markers[0].markers) {
    EXPECT_EQ(marker.header.stamp, image.header.stamp);
    EXPECT_EQ(marker.header.frame_id, "eye");
  }
}

TEST_F(TrackingTest, ResetStartsAgainFromThePointsGiven) {
  BottlePose pose;
  startBottle(pose);
  for (int k = 0; k < 6; ++k) {
    pose.centre.x += 6.0;
    showBottle(pose);
  }
  const auto answer = client_.call<std_srvs::Trigger>("reset");
  EXPECT_TRUE(answer.response.success);
  EXPECT_EQ(answer.response.message.substr(0, 1), "1");
  const auto object = showBottle(BottlePose());
  ASSERT_TRUE(object);
  EXPECT_EQ(object->state, TrackedObject::INITIALIZING);
  EXPECT_TRUE(isAt(object, BottlePose(), 1.0));
}

TEST_F(TrackingTest, PauseIgnoresImages) {
  startBottle(BottlePose());
  std_srvs::SetBool pause;
  pause.request.data = true;
  EXPECT_TRUE(client_.call("pause", pause).response.success);
  const std::size_t before = client_.received().size();
  client_.publish(*imageMsg(scene_.with({BottlePose()}), nextStamp()));
  EXPECT_FALSE(waitUntil([&] { return client_.received().size() > before; }, 0.5));
  const auto refused = client_.setTarget(bottleRequest("other", BottlePose()), cv::Mat());
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("paused"), std::string::npos);
  pause.request.data = false;
  client_.call("pause", pause);
  EXPECT_TRUE(isAt(showBottle(BottlePose()), BottlePose()));
}

TEST_F(TrackingTest, RemoveForgetsTheObject) {
  startBottle(BottlePose());
  RemoveTarget service;
  service.request.id = "bottle";
  EXPECT_TRUE(client_.call("remove_target", service).response.success);
  const auto objects = client_.show(scene_.with({BottlePose()}));
  ASSERT_TRUE(objects);
  EXPECT_TRUE(objects->objects.empty());
  EXPECT_FALSE(client_.call("remove_target", service).response.success);
}

TEST_F(TrackingTest, DiagnosticsTellOfTheObject) {
  startBottle(BottlePose());
  bool told = false;
  ros::NodeHandle node;
  const ros::Subscriber subscriber = node.subscribe<diagnostic_msgs::DiagnosticArray>(
      "/diagnostics", 10, [&](const diagnostic_msgs::DiagnosticArrayConstPtr& array) {
        for (const auto& status : array->status) {
          for (const auto& value : status.values) told |= value.key == "Confidence of bottle";
        }
      });
  EXPECT_TRUE(waitUntil([&] {
    showBottle(BottlePose());
    return told;
  }));
}

}  // namespace
}  // namespace chain_tracker

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "tracking_rostest");
  const ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
