// SPDX-License-Identifier: BSD-3-Clause
/// What a tracker published about an object, back as what it knew.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <ros/time.h>

#include "chain_tracker/TrackedObject.h"
#include "chain_tracker/evaluation/evaluation_run.h"
#include "chain_tracker/evaluation/ground_truth.h"

namespace chain_tracker {

/// Upright box of the object; empty if it is lost.
cv::Rect2d boxOf(const TrackedObject& object);

/// The messages about one object of a topic.
struct ObjectRecording {
  std::string id;                       ///< of the object; empty if none was told of
  std::string model;                    ///< its model's name
  std::map<int, RecordedFrame> frames;  ///< by the index of the image of the same stamp
  int without_image = 0;                ///< messages whose stamp no image has
  int damaged = 0;                      ///< messages that cannot be read
  /// Frames whose message does not tell of the object: it was not known yet, or is not there.
  std::vector<int> frames_without_object;
  std::set<std::string> ids;  ///< of all objects that were told of
};

/// For people: 'a', 'b'.
std::string namesOf(const std::set<std::string>& ids);

/// Reads a chain_tracker/TrackedObjectArray topic. `index_of`: the images' (indexByStamp()). `id`:
/// of the object, empty for the first one that was told of.
/// Throws std::invalid_argument as BagTopic does, and naming the objects that are there if that of
/// the id is not.
ObjectRecording readRecording(const std::string& bag, const std::string& topic,
                              const std::map<ros::Time, int>& index_of, const std::string& id);

/// Throws as readRecording() does where there is nothing to read.
void checkRecording(const std::string& bag, const std::string& topic);

/// A recording taken for the truth: points and boxes of the frames in which it was not lost; no
/// object where the messages do not tell of it.
GroundTruth truthFrom(const ObjectRecording& recording);

}  // namespace chain_tracker
