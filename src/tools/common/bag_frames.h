// SPDX-License-Identifier: BSD-3-Clause
/// Frames out of a bag, without a ROS master.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <ros/time.h>

#include "chain_tracker/evaluation/frame_source.h"

namespace chain_tracker {

/// The images of a topic (sensor_msgs/Image or CompressedImage) in the order of recording,
/// converted as the nodelet converts them. A message that cannot be decoded is a frame with a
/// fault. Throws std::invalid_argument naming the bag if it cannot be read (a truncated one: what
/// to do), or the topics with images there are if `topic` is not one of them.
std::unique_ptr<FrameSource> openBagFrames(const std::string& bag, const std::string& topic);

/// What a user should know before trusting a recording: gaps, stamps that go back, frame ids and
/// encodings that change. One line each; empty if all is well. Throws as above.
std::vector<std::string> checkBag(const std::string& bag, const std::string& topic);

/// Index of each image by its header's stamp; of the first one where several share a stamp.
/// Throws as above.
std::map<ros::Time, int> indexByStamp(const std::string& bag, const std::string& topic);

/// The same of the images that can be read. Throws std::invalid_argument naming the bag if what a
/// live tracker publishes cannot be told by the image's stamp: where an image has none, or that of
/// another one. Throws as above, too.
std::map<ros::Time, int> indexByOwnStamps(const std::string& bag, const std::string& topic);

/// Between two images [s]; 0 if there is at most one.
double longestPause(const std::map<ros::Time, int>& index_of);

}  // namespace chain_tracker
