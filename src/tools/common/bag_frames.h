// SPDX-License-Identifier: BSD-3-Clause
/// Frames and ground truth out of a bag, without a ROS master.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "chain_tracker/evaluation/frame_source.h"
#include "chain_tracker/evaluation/ground_truth.h"

namespace chain_tracker {

/// The images of a topic (sensor_msgs/Image or CompressedImage) in the order of their stamps of
/// recording. A message that cannot be decoded is a frame with a fault.
/// Throws std::invalid_argument naming the bag if it cannot be read (a truncated one: what to do),
/// or the topics with images there are if `topic` is not one of them.
std::unique_ptr<FrameSource> openBagFrames(const std::string& bag, const std::string& topic);

/// What a user should know before trusting a recording: gaps, stamps that go back, frame ids and
/// encodings that change. One line each; empty if all is well. Throws as above.
std::vector<std::string> checkBag(const std::string& bag, const std::string& topic);

/// Truth from a recorded chain_tracker/TrackedObjectArray topic: the carried points and boxes of
/// the first object, matched to the images by stamp. Throws as above, naming the topic.
GroundTruth readTruthTopic(const std::string& bag, const std::string& truth_topic,
                           const std::string& image_topic);

}  // namespace chain_tracker
