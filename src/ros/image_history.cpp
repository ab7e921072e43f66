// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/ros/image_history.h"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "chain_tracker/ros/stamp_order.h"

namespace chain_tracker {
namespace {

bool belongTogether(const sensor_msgs::Image& earlier, const sensor_msgs::Image& later) {
  return earlier.width == later.width && earlier.height == later.height &&
         !wentBack(earlier.header.stamp, later.header.stamp);
}

}  // namespace

void ImageHistory::add(const Frame& frame) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!frames_.empty() && !belongTogether(*frames_.back().image, *frame.image)) frames_.clear();
  frames_.push_back(frame);
  while (frames_.size() > capacity_) frames_.pop_front();
}

std::deque<Frame>::const_iterator ImageHistory::find(const ros::Time& stamp) const {
  return std::find_if(frames_.begin(), frames_.end(),
                      [&stamp](const Frame& frame) { return frame.image->header.stamp == stamp; });
}

bool ImageHistory::holds(const ros::Time& stamp) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return find(stamp) != frames_.end();
}

Frame ImageHistory::at(const ros::Time& stamp) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = find(stamp);
  if (found != frames_.end()) return *found;

  std::ostringstream reason;
  reason << "stamp is " << stamp
         << " [s], must be 0 (the next image) or the stamp of an image held";
  if (frames_.empty()) {
    reason << "; none of at most " << capacity_ << " is held";
  } else {
    reason << "; " << frames_.size() << " of at most " << capacity_ << " are held, from "
           << frames_.front().image->header.stamp << " to " << frames_.back().image->header.stamp;
  }
  throw std::invalid_argument(reason.str());
}

std::vector<Frame> ImageHistory::between(std::uint64_t after, std::uint64_t up_to) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<Frame> frames;
  std::copy_if(frames_.begin(), frames_.end(), std::back_inserter(frames),
               [=](const Frame& frame) { return frame.number > after && frame.number <= up_to; });
  return frames;
}

}  // namespace chain_tracker
