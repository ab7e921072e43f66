// SPDX-License-Identifier: BSD-3-Clause
#include <sstream>
#include <stdexcept>

#include "chain_tracker/ros/parameters.h"

namespace chain_tracker {
namespace {

using XmlRpc::XmlRpcValue;

constexpr char kTargetForm[] = "{id: string, model: string, points: [[x, y], ...]}";

std::invalid_argument fault(const std::string& key, const XmlRpcValue& value,
                            const std::string& allowed) {
  std::ostringstream text;
  text << "~" << key << " is ";
  value.write(text);
  text << ", must be " << allowed;
  return std::invalid_argument(text.str());
}

std::invalid_argument unknownKey(const std::string& place, const std::string& key,
                                 const XmlRpcValue& value) {
  return fault(place + "/" + key, value, std::string("left out: the form is ") + kTargetForm);
}

bool isArray(const XmlRpcValue& value) { return value.getType() == XmlRpcValue::TypeArray; }

double coordinateFrom(const std::string& key, const XmlRpcValue& value) {
  if (value.getType() == XmlRpcValue::TypeInt) return static_cast<int>(value);
  if (value.getType() == XmlRpcValue::TypeDouble) return static_cast<double>(value);
  throw fault(key, value, "a number [px]");
}

std::vector<cv::Point2d> pointsFrom(const std::string& key, const XmlRpcValue& list) {
  if (!isArray(list) || list.size() < 2) {
    throw fault(key, list, "a list of at least two points [[x, y], ...] [px]");
  }
  std::vector<cv::Point2d> points;
  for (int i = 0; i < list.size(); ++i) {
    if (!isArray(list[i]) || list[i].size() != 2) throw fault(key, list[i], "[x, y] [px]");
    points.emplace_back(coordinateFrom(key, list[i][0]), coordinateFrom(key, list[i][1]));
  }
  return points;
}

/// The string at `key`, or `missing` where there is no such key.
std::string textFrom(const std::string& place, const XmlRpcValue& target, const std::string& key,
                     const std::string& missing) {
  if (!target.hasMember(key)) return missing;
  const XmlRpcValue& value = target[key];
  if (value.getType() != XmlRpcValue::TypeString || static_cast<std::string>(value).empty()) {
    throw fault(place + "/" + key, value, "a string that is not empty");
  }
  return static_cast<std::string>(value);
}

TargetRequest requestFrom(const std::string& place, const XmlRpcValue& target,
                          const TrackerParameters& parameters) {
  if (target.getType() != XmlRpcValue::TypeStruct || !target.hasMember("points")) {
    throw fault(place, target, kTargetForm);
  }
  for (const auto& [key, value] : target) {
    if (key != "id" && key != "model" && key != "points") {
      throw unknownKey(place, key, value);
    }
  }
  return {textFrom(place, target, "id", parameters.default_id),
          textFrom(place, target, "model", parameters.default_model),
          pointsFrom(place + "/points", target["points"])};
}

/// As a launch file can pass them on.
std::vector<cv::Point2d> pointsFromString(const XmlRpcValue& value) {
  std::optional<std::vector<cv::Point2d>> points;
  if (value.getType() == XmlRpcValue::TypeString) {
    points = pointsFromText(static_cast<std::string>(value));
  }
  if (points) return *points;
  throw fault("points", value, "empty or at least two points \"x,y,x,y,...\" [px]");
}

/// Two objects of one id would be one object.
void add(const std::string& place, const TargetRequest& request, InitialTargets* targets) {
  for (const TargetRequest& other : targets->requests) {
    if (other.id == request.id) {
      throw std::invalid_argument("~" + place + " has the id '" + request.id +
                                  "', must be one that no other object has");
    }
  }
  targets->requests.push_back(request);
}

void readTargetList(const XmlRpcValue& list, const TrackerParameters& parameters,
                    InitialTargets* targets) {
  if (!isArray(list)) {
    targets->faults.push_back(
        fault("targets", list, std::string("a list of ") + kTargetForm).what());
    return;
  }
  for (int i = 0; i < list.size(); ++i) {
    try {
      const std::string place = "targets[" + std::to_string(i) + "]";
      add(place, requestFrom(place, list[i], parameters), targets);
    } catch (const std::invalid_argument& error) {
      targets->faults.push_back(error.what());
    }
  }
}

}  // namespace

std::optional<std::vector<cv::Point2d>> pointsFromText(const std::string& text) {
  std::istringstream stream(text);
  std::vector<double> numbers;
  std::string word;
  while (std::getline(stream, word, ',')) {
    std::istringstream word_text(word);
    double number = 0.0;
    if (!(word_text >> number) || !(word_text >> std::ws).eof()) return std::nullopt;
    numbers.push_back(number);
  }
  if (numbers.size() < 4 || numbers.size() % 2 != 0) return std::nullopt;
  std::vector<cv::Point2d> points;
  points.reserve(numbers.size() / 2);
  for (std::size_t i = 0; i < numbers.size(); i += 2) {
    points.emplace_back(numbers[i], numbers[i + 1]);
  }
  return points;
}

InitialTargets initialTargetsFrom(const XmlRpcValue& tree, const TrackerParameters& parameters) {
  InitialTargets targets;
  if (!tree.valid()) return targets;
  if (tree.hasMember("targets")) readTargetList(tree["targets"], parameters, &targets);
  if (!tree.hasMember("points")) return targets;
  const XmlRpcValue& text = tree["points"];
  const bool none =
      text.getType() == XmlRpcValue::TypeString && static_cast<std::string>(text).empty();
  if (none) return targets;
  try {
    add("points", {parameters.default_id, parameters.default_model, pointsFromString(text)},
        &targets);
  } catch (const std::invalid_argument& error) {
    targets.faults.push_back(error.what());
  }
  return targets;
}

}  // namespace chain_tracker
