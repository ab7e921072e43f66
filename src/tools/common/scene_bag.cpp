// SPDX-License-Identifier: BSD-3-Clause
#include "scene_bag.h"

#include <algorithm>
#include <vector>

#include <cv_bridge/cv_bridge.h>
#include <rosbag/bag.h>
#include <sensor_msgs/image_encodings.h>

#include "chain_tracker/TrackedObjectArray.h"
#include "free_space.h"

namespace chain_tracker {
namespace {

constexpr double kRate = 30.0;
constexpr double kFirstStamp = 1.0;  // 0 stands for "no stamp"

std_msgs::Header headerOf(int index) {
  std_msgs::Header header;
  header.stamp = ros::Time(kFirstStamp + index / kRate);
  header.frame_id = "camera";
  return header;
}

sensor_msgs::ImagePtr imageMsg(const cv::Mat3b& image, bool grey, const std_msgs::Header& header) {
  if (!grey) return cv_bridge::CvImage(header, "bgr8", image).toImageMsg();
  cv::Mat channel;
  cv::extractChannel(image, channel, 0);
  return cv_bridge::CvImage(header, "mono8", channel).toImageMsg();
}

geometry_msgs::Pose2D poseMsg(const Similarity& transform) {
  geometry_msgs::Pose2D pose;
  pose.x = transform.translation.x;
  pose.y = transform.translation.y;
  pose.theta = wrapAngle(transform.angle);
  return pose;
}

geometry_msgs::Polygon outlineMsg(const cv::Rect2d& box) {
  const cv::Point2d high = box.br();
  geometry_msgs::Polygon polygon;
  for (const cv::Point2d& corner :
       {box.tl(), cv::Point2d(high.x, box.y), high, cv::Point2d(box.x, high.y), box.tl()}) {
    geometry_msgs::Point32 point;
    point.x = static_cast<float>(corner.x);
    point.y = static_cast<float>(corner.y);
    polygon.points.push_back(point);
  }
  return polygon;
}

std::uint8_t stateOf(const SceneFrame& frame, int index) {
  if (index == 0) return TrackedObject::INITIALIZING;
  const bool seen =
      std::all_of(frame.visible.begin(), frame.visible.end(), [](bool v) { return v; });
  return seen ? TrackedObject::TRACKING : TrackedObject::OCCLUDED;
}

TrackedObject truthMsg(const SceneFrame& frame, int index, const std::string& model) {
  TrackedObject object;
  object.id = "truth";
  object.model = model;
  object.state = stateOf(frame, index);
  object.confidence = 1.0F;
  object.pose = poseMsg(frame.image_from_object);
  object.scale = static_cast<float>(frame.image_from_object.scale);
  for (const Similarity& transform : frame.segments) {
    SegmentPose segment;
    segment.pose = poseMsg(transform);
    segment.scale = static_cast<float>(transform.scale);
    segment.confidence = 1.0F;
    object.segments.push_back(segment);
  }
  for (std::size_t k = 0; k < frame.points.size(); ++k) {
    TrackedPoint point;
    point.x = static_cast<float>(frame.points[k].x);
    point.y = static_cast<float>(frame.points[k].y);
    point.confidence = 1.0F;
    point.visible = frame.visible[k];
    object.points.push_back(point);
  }
  object.outline = outlineMsg(frame.box);
  object.box = {frame.box.x, frame.box.y, frame.box.width, frame.box.height};
  return object;
}

}  // namespace

void writeSceneBag(const SyntheticScene& scene, const SceneOptions& options,
                   const std::string& path) {
  const auto frames = static_cast<std::uintmax_t>(options.frames);
  const auto pixels = static_cast<std::uintmax_t>(options.size.area());
  requireSpace(path, frames * pixels * (options.grey ? 1 : 3));
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  for (int index = 0; index < options.frames; ++index) {
    const SceneFrame frame = scene.render(index);
    TrackedObjectArray truth;
    truth.header = headerOf(index);
    if (frame.in_view) truth.objects.push_back(truthMsg(frame, index, scene.model()));
    bag.write(kSceneImageTopic, truth.header.stamp,
              imageMsg(frame.image, options.grey, truth.header));
    bag.write(kSceneTruthTopic, truth.header.stamp, truth);
  }
}

}  // namespace chain_tracker
