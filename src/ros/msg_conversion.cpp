// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/ros/msg_conversion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace chain_tracker {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::uint8_t toMsg(TrackingStatus status) {
  switch (status) {
    case TrackingStatus::kInitializing:
      return TrackedObject::INITIALIZING;
    case TrackingStatus::kTracking:
      return TrackedObject::TRACKING;
    case TrackingStatus::kOccluded:
      return TrackedObject::OCCLUDED;
    case TrackingStatus::kLost:
      break;
  }
  return TrackedObject::LOST;
}

geometry_msgs::Pose2D poseMsg(const cv::Point2d& position, double angle) {
  geometry_msgs::Pose2D pose;
  pose.x = position.x;
  pose.y = position.y;
  pose.theta = wrapAngle(angle);
  return pose;
}

geometry_msgs::Pose2D unknownPose() {
  geometry_msgs::Pose2D pose;
  pose.x = pose.y = pose.theta = kNaN;
  return pose;
}

PartPose toMsg(const PartState& part, const std::string& name, bool lost) {
  PartPose message;
  message.name = name;
  message.pose = lost ? unknownPose() : poseMsg(part.position, part.orientation);
  message.size = static_cast<float>(lost ? kNaN : part.side);
  message.confidence = static_cast<float>(lost ? 0.0 : part.confidence);
  message.visible = part.visible && !lost;
  const bool known = !lost && std::isfinite(cv::sum(part.covariance)[0]);
  for (std::size_t i = 0; i < message.covariance.size(); ++i) {
    message.covariance[i] = known ? static_cast<float>(part.covariance.val[i]) : -1.0f;
  }
  message.position.x = message.position.y = message.position.z = kNaN;
  return message;
}

SegmentPose toMsg(const SegmentState& segment, bool lost) {
  SegmentPose message;
  message.name = segment.name;
  const Similarity& pose = segment.image_from_segment;
  message.pose = lost ? unknownPose() : poseMsg(pose.translation, pose.angle);
  message.scale = static_cast<float>(lost ? kNaN : pose.scale);
  message.confidence = static_cast<float>(lost ? 0.0 : segment.confidence);
  message.first_part = static_cast<std::uint32_t>(segment.first_part);
  message.part_count = static_cast<std::uint32_t>(segment.part_count);
  return message;
}

TrackedPoint toMsg(const CarriedPoint& point, bool lost) {
  TrackedPoint message;
  message.x = static_cast<float>(lost ? kNaN : point.position.x);
  message.y = static_cast<float>(lost ? kNaN : point.position.y);
  message.confidence = static_cast<float>(lost ? 0.0 : point.confidence);
  message.visible = point.visible && !lost;
  return message;
}

geometry_msgs::Polygon polygonMsg(const std::vector<cv::Point2d>& corners) {
  geometry_msgs::Polygon polygon;
  for (const cv::Point2d& corner : corners) {
    geometry_msgs::Point32 point;
    point.x = static_cast<float>(corner.x);
    point.y = static_cast<float>(corner.y);
    polygon.points.push_back(point);
  }
  return polygon;
}

sensor_msgs::RegionOfInterest regionMsg(const cv::Rect2d& box, const cv::Size& image_size) {
  // Cut before rounding: a box far outside would not fit into an integer.
  const cv::Rect2d inside = box & cv::Rect2d(cv::Point2d(), cv::Size2d(image_size));
  const cv::Point first(cvRound(inside.x), cvRound(inside.y));
  const cv::Point end(cvRound(inside.x + inside.width), cvRound(inside.y + inside.height));
  const cv::Rect pixels = cv::Rect(first, end) & cv::Rect(cv::Point(), image_size);
  sensor_msgs::RegionOfInterest region;
  if (pixels.empty()) return region;
  region.x_offset = static_cast<std::uint32_t>(pixels.x);
  region.y_offset = static_cast<std::uint32_t>(pixels.y);
  region.width = static_cast<std::uint32_t>(pixels.width);
  region.height = static_cast<std::uint32_t>(pixels.height);
  return region;
}

}  // namespace

TrackedObject toMsg(const ChainState& state, const std::string& id, const std::string& model,
                    const cv::Size& image_size) {
  const bool lost = state.status == TrackingStatus::kLost;
  TrackedObject message;
  message.id = id;
  message.model = model;
  message.state = toMsg(state.status);
  message.confidence = static_cast<float>(state.confidence);
  message.pose = unknownPose();
  message.scale = static_cast<float>(kNaN);
  message.box.fill(kNaN);
  for (const SegmentState& segment : state.segments) {
    message.segments.push_back(toMsg(segment, lost));
    for (int k = 0; k < segment.part_count; ++k) {
      const auto part = static_cast<std::size_t>(segment.first_part) + static_cast<std::size_t>(k);
      message.parts.push_back(
          toMsg(state.parts.at(part), segment.name + "/" + std::to_string(k), lost));
    }
  }
  for (const CarriedPoint& point : state.points) message.points.push_back(toMsg(point, lost));
  if (lost) return message;

  const Similarity pose = meanPose(state);
  message.pose = poseMsg(pose.translation, pose.angle);
  message.scale = static_cast<float>(pose.scale);
  message.outline = polygonMsg(state.outline);
  message.box = {state.box.x, state.box.y, state.box.width, state.box.height};
  message.roi = regionMsg(uprightBounds(state.outline), image_size);
  return message;
}

std::string stateName(std::uint8_t state) {
  for (const TrackingStatus status : {TrackingStatus::kInitializing, TrackingStatus::kTracking,
                                      TrackingStatus::kOccluded, TrackingStatus::kLost}) {
    if (toMsg(status) == state) return toString(status);
  }
  return "UNKNOWN";
}

}  // namespace chain_tracker
