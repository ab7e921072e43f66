// SPDX-License-Identifier: BSD-3-Clause
#include "recorded_objects.h"

#include <algorithm>
#include <stdexcept>

#include "bag_topic.h"
#include "chain_tracker/TrackedObjectArray.h"
#include "chain_tracker/ros/msg_conversion.h"

namespace chain_tracker {
namespace {

constexpr const char* kObjectsType = "chain_tracker/TrackedObjectArray";

PartState partFrom(const PartPose& message) {
  PartState part;
  part.position = {message.pose.x, message.pose.y};
  part.orientation = message.pose.theta;
  part.side = message.size;
  part.confidence = message.confidence;
  part.visible = message.visible != 0;
  return part;
}

TrackedFrame frameFrom(const TrackedObject& object) {
  TrackedFrame frame;
  frame.state = stateName(object.state);
  frame.confidence = object.confidence;
  frame.lost = object.state == TrackedObject::LOST;
  frame.box = boxOf(object);
  for (const geometry_msgs::Point32& corner : object.outline.points) {
    frame.outline.emplace_back(corner.x, corner.y);
  }
  frame.theta = object.pose.theta;
  frame.scale = object.scale;
  for (const PartPose& part : object.parts) frame.parts.push_back(partFrom(part));
  for (const TrackedPoint& point : object.points) {
    frame.points.push_back({{point.x, point.y}, point.confidence, point.visible != 0});
  }
  return frame;
}

/// Null if the bag is damaged there.
TrackedObjectArray::ConstPtr arrayFrom(const rosbag::MessageInstance& message) {
  try {
    return message.instantiate<TrackedObjectArray>();
  } catch (const std::exception&) {
    return nullptr;
  }
}

/// The object of that id, the first one for an empty id; null if there is none.
const TrackedObject* findObject(const TrackedObjectArray& array, const std::string& id) {
  const auto found =
      std::find_if(array.objects.begin(), array.objects.end(),
                   [&](const TrackedObject& object) { return id.empty() || object.id == id; });
  return found == array.objects.end() ? nullptr : &*found;
}

}  // namespace

std::string namesOf(const std::set<std::string>& ids) {
  std::string names;
  for (const std::string& id : ids) names += (names.empty() ? "'" : ", '") + id + "'";
  return names;
}

cv::Rect2d boxOf(const TrackedObject& object) {
  if (object.state == TrackedObject::LOST) return {};
  return {object.box[0], object.box[1], object.box[2], object.box[3]};
}

ObjectRecording readRecording(const std::string& bag, const std::string& topic,
                              const std::map<ros::Time, int>& index_of, const std::string& id) {
  ObjectRecording recording;
  recording.id = id;
  BagTopic messages(bag, topic, {kObjectsType});
  for (const rosbag::MessageInstance& message : messages.view()) {
    const auto array = arrayFrom(message);
    if (array == nullptr) {
      ++recording.damaged;
      continue;
    }
    for (const TrackedObject& object : array->objects) recording.ids.insert(object.id);
    const auto frame = index_of.find(array->header.stamp);
    if (frame == index_of.end()) {
      ++recording.without_image;
      continue;
    }
    const TrackedObject* object = findObject(*array, recording.id);
    if (object == nullptr) {
      recording.frames_without_object.push_back(frame->second);
      continue;
    }
    recording.id = object->id;
    recording.model = object->model;
    recording.frames[frame->second] = {array->processing_time.toSec() * 1e3, frameFrom(*object)};
  }
  if (!id.empty() && recording.ids.count(id) == 0) {
    throw std::invalid_argument(
        bag + ": no message on " + topic + " tells of '" + id + "', " +
        (recording.ids.empty() ? "nor of any object" : "only of " + namesOf(recording.ids)));
  }
  return recording;
}

void checkRecording(const std::string& bag, const std::string& topic) {
  BagTopic(bag, topic, {kObjectsType});
}

GroundTruth truthFrom(const ObjectRecording& recording) {
  GroundTruth truth;
  for (const int frame : recording.frames_without_object) truth.boxes[frame] = std::nullopt;
  for (const auto& [frame, recorded] : recording.frames) {
    const TrackedFrame& tracked = recorded.tracked;
    if (tracked.lost) continue;
    if (!tracked.box.empty()) truth.boxes[frame] = tracked.box;
    int index = 0;
    for (const CarriedPoint& point : tracked.points) {
      truth.points[frame][index++] = {point.position, point.visible};
    }
  }
  return truth;
}

}  // namespace chain_tracker
