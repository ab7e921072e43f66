// SPDX-License-Identifier: BSD-3-Clause
/// One topic of a recorded bag.
#pragma once

#include <set>
#include <string>

#include <rosbag/bag.h>
#include <rosbag/view.h>

namespace chain_tracker {

class BagTopic {
 public:
  /// Opens the bag for the messages of `topic`, which must have one of the `types`.
  /// Throws std::invalid_argument naming the bag: if it cannot be read, what to do about it; if the
  /// topic is not there, those of these types that are.
  BagTopic(const std::string& path, const std::string& topic, const std::set<std::string>& types);

  rosbag::View& view() { return view_; }

 private:
  rosbag::Bag bag_;
  rosbag::View view_;
};

}  // namespace chain_tracker
