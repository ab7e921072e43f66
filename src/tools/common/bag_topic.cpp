// SPDX-License-Identifier: BSD-3-Clause
#include "bag_topic.h"

#include <filesystem>
#include <stdexcept>

namespace chain_tracker {
namespace {

/// A recording that was cut off has no index, or one that points behind the end of the file.
std::invalid_argument unreadable(const std::string& path, const std::string& reason) {
  return std::invalid_argument(path + " cannot be read as a bag (" + reason +
                               "); if the recording was cut off, `rosbag reindex " + path +
                               "` can repair it");
}

std::string joined(const std::set<std::string>& words, const std::string& separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

/// Topics of the bag that have one of the types.
std::set<std::string> topicsOf(const rosbag::Bag& bag, const std::set<std::string>& types) {
  rosbag::View all(bag);
  std::set<std::string> topics;
  for (const rosbag::ConnectionInfo* connection : all.getConnections()) {
    if (types.count(connection->datatype) != 0) topics.insert(connection->topic);
  }
  return topics;
}

}  // namespace

BagTopic::BagTopic(const std::string& path, const std::string& topic,
                   const std::set<std::string>& types) {
  if (!std::filesystem::is_regular_file(path)) {
    throw std::invalid_argument("bag " + path + " does not exist");
  }
  std::set<std::string> known;
  try {
    bag_.open(path, rosbag::bagmode::Read);
    known = topicsOf(bag_, types);
    view_.addQuery(bag_, rosbag::TopicQuery(topic));
  } catch (const rosbag::BagException& error) {
    throw unreadable(path, error.what());
  }
  if (known.count(topic) != 0) return;
  throw std::invalid_argument(
      path + " has no topic '" + topic + "' of type " + joined(types, " or ") +
      "; topics of that type: " + (known.empty() ? "none" : joined(known, ", ")));
}

}  // namespace chain_tracker
