// SPDX-License-Identifier: BSD-3-Clause
/// Private parameters of the programs that are nodes.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

#include <ros/node_handle.h>

namespace chain_tracker {

/// The parameter, or `fallback` where there is none. Throws std::invalid_argument naming the
/// parameter, its value and what is `allowed` where it has another type.
template <typename Value>
Value readParameter(const ros::NodeHandle& node, const std::string& key, const Value& fallback,
                    const std::string& allowed) {
  Value value = fallback;
  XmlRpc::XmlRpcValue given;
  if (!node.getParam(key, given) || node.getParam(key, value)) return value;
  std::ostringstream text;
  text << "~" << key << " is ";
  given.write(text);
  throw std::invalid_argument(text.str() + ", must be " + allowed);
}

inline std::string readText(const ros::NodeHandle& node, const std::string& key) {
  return readParameter<std::string>(node, key, "", "a string");
}

/// Seconds > 0. Throws as above.
inline double readSeconds(const ros::NodeHandle& node, const std::string& key, double fallback) {
  const double value = readParameter(node, key, fallback, "a number > 0 [s]");
  if (value > 0.0) return value;
  throw std::invalid_argument("~" + key + " is " + std::to_string(value) +
                              ", must be a number > 0 [s]");
}

}  // namespace chain_tracker
