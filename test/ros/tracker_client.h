// SPDX-License-Identifier: BSD-3-Clause
/// Talks to a running tracker: shows it images, awaits its answers. Every wait has a deadline in
/// wall time.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include "chain_tracker/RemoveTarget.h"
#include "chain_tracker/SetTarget.h"
#include "chain_tracker/TrackedObjectArray.h"
#include "ros/rendered_scene.h"

namespace chain_tracker {

constexpr double kDeadline = 20.0;  ///< for anything that must happen [s]

/// Spins until the condition holds; false if it does not in time.
inline bool waitUntil(const std::function<bool()>& condition, double seconds = kDeadline) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(seconds);
  while (!condition()) {
    if (ros::WallTime::now() > end || !ros::ok()) return false;
    ros::spinOnce();
    ros::WallDuration(0.001).sleep();
  }
  return true;
}

/// Stamps that go forward through all tests of a program.
inline ros::Time nextStamp() {
  static ros::Time stamp(1000.0);
  return stamp += ros::Duration(0.1);
}

class TrackerClient {
 public:
  /// `listeners`: trackers on the image topic. All of them have to be connected: one that is not
  /// yet would miss the first image.
  explicit TrackerClient(const std::string& tracker, const std::string& image_topic = "image",
                         std::uint32_t listeners = 1)
      : tracker_(tracker) {
    ros::NodeHandle node;
    images_ = node.advertise<sensor_msgs::Image>(image_topic, 100);
    objects_ = node.subscribe(tracker + "/objects", 100, &TrackerClient::receive, this);
    ready_ = waitUntil([&] {
      return images_.getNumSubscribers() >= listeners && objects_.getNumPublishers() > 0 &&
             ros::service::exists(tracker_ + "/set_target", false);
    });
  }

  bool ready() const { return ready_; }
  const std::vector<TrackedObjectArray>& received() const { return received_; }

  void publish(const sensor_msgs::Image& image) { images_.publish(image); }

  /// Shows an image and waits for the message about it.
  std::optional<TrackedObjectArray> show(const sensor_msgs::Image& image) {
    const std::size_t count = received_.size();
    publish(image);
    if (!waitUntil([&] { return received_.size() > count; })) return std::nullopt;
    return received_.back();
  }

  std::optional<TrackedObjectArray> show(const cv::Mat& image) {
    return show(*imageMsg(image, nextStamp()));
  }

  /// Calls ~set_target; shows `image` again and again, if there is one, until the answer is there.
  SetTarget::Response setTarget(const SetTarget::Request& request, const cv::Mat& image) {
    auto call = std::async(std::launch::async, [this, request] {
      SetTarget service;
      service.request = request;
      if (!ros::service::call(tracker_ + "/set_target", service)) {
        service.response.message = "the call failed";
      }
      return service.response;
    });
    const bool answered = waitUntil([&] {
      if (call.wait_for(std::chrono::seconds(0)) == std::future_status::ready) return true;
      if (!image.empty()) show(image);
      return false;
    });
    EXPECT_TRUE(answered) << "no answer from ~set_target";
    return call.get();
  }

  template <typename Service>
  Service call(const std::string& name, Service service = Service()) {
    EXPECT_TRUE(ros::service::call(tracker_ + "/" + name, service)) << name;
    return service;
  }

  void remove(const std::string& id) {
    RemoveTarget service;
    service.request.id = id;
    call("remove_target", service);
  }

 private:
  void receive(const TrackedObjectArray& objects) { received_.push_back(objects); }

  std::string tracker_;
  ros::Publisher images_;
  ros::Subscriber objects_;
  std::vector<TrackedObjectArray> received_;
  bool ready_ = false;
};

inline SetTarget::Request targetRequest(const std::string& id,
                                        const std::vector<cv::Point2d>& points) {
  SetTarget::Request request;
  request.id = id;
  for (const cv::Point2d& point : points) {
    geometry_msgs::Point32 message;
    message.x = static_cast<float>(point.x);
    message.y = static_cast<float>(point.y);
    request.points.push_back(message);
  }
  return request;
}

inline SetTarget::Request bottleRequest(const std::string& id, const BottlePose& pose) {
  return targetRequest(id, RenderedScene::endsOf(pose));
}

/// The object of that id, or nothing.
inline std::optional<TrackedObject> objectOf(const std::optional<TrackedObjectArray>& array,
                                             const std::string& id) {
  if (!array) return std::nullopt;
  for (const TrackedObject& object : array->objects) {
    if (object.id == id) return object;
  }
  return std::nullopt;
}

/// Whether the object is found at the bottle's place.
inline testing::AssertionResult isAt(const std::optional<TrackedObject>& object,
                                     const BottlePose& pose, double tolerance = 5.0) {
  if (!object) return testing::AssertionFailure() << "no such object";
  if (object->state == TrackedObject::LOST) return testing::AssertionFailure() << "lost";
  const cv::Point2d centre(object->pose.x, object->pose.y);
  if (cv::norm(centre - pose.centre) <= tolerance) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "at " << centre << ", not at " << pose.centre;
}

}  // namespace chain_tracker
