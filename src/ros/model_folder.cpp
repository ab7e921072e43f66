// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/ros/model_folder.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include <ros/package.h>

#include "chain_tracker/chain/auto_model.h"
#include "chain_tracker/chain/chain_model_io.h"

namespace chain_tracker {
namespace {

constexpr char kExtension[] = ".yaml";
constexpr char kAuto[] = "auto";

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

bool isFile(const std::string& name_or_file) {
  return std::filesystem::path(name_or_file).extension() == kExtension;
}

}  // namespace

std::string ModelFolder::ofThisPackage() {
  const std::string package = ros::package::getPath("chain_tracker");
  return package.empty() ? "" : package + "/config/models";
}

bool ModelFolder::has(const std::string& name) const {
  const std::vector<std::string> known = names();
  return std::binary_search(known.begin(), known.end(), name);
}

std::vector<std::string> ModelFolder::names() const {
  std::vector<std::string> names;
  std::error_code no_folder;  // a folder that cannot be read has no names
  for (const auto& entry : std::filesystem::directory_iterator(path_, no_folder)) {
    if (entry.path().extension() == kExtension) names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

ChainModel ModelFolder::load(const std::string& name_or_file) const {
  if (isFile(name_or_file)) return loadChainModel(name_or_file);
  if (path_.empty()) {
    throw std::invalid_argument("model '" + name_or_file +
                                "' is not found: no folder of models is known, as ~models_folder "
                                "is not set and ROS does not "
                                "find the package chain_tracker (source its setup.bash)");
  }
  if (!has(name_or_file)) {
    throw std::invalid_argument("model '" + name_or_file + "' is unknown, must be auto, a file (*" +
                                kExtension + ") or one of those in " + path_ + ": " +
                                joined(names()));
  }
  return loadChainModel(path_ + "/" + name_or_file + kExtension);
}

ChainModel ModelFolder::loadFor(const std::vector<cv::Point2d>& points,
                                const std::string& name_or_file) const {
  if (isFile(name_or_file)) return load(name_or_file);
  if (points.size() < 2) {
    throw std::invalid_argument("the object is given " + std::to_string(points.size()) +
                                " points, must be at least 2");
  }
  if (name_or_file != kAuto) return withRoomForParts(load(name_or_file), points);
  return loadForAuto(points, autoModelName(points));
}

ChainModel ModelFolder::loadForAuto(const std::vector<cv::Point2d>& points,
                                    const std::string& name) const {
  const ModelFolder folder = has(name) ? *this : ModelFolder(ofThisPackage());
  return withRoomForParts(folder.load(name), points);
}

}  // namespace chain_tracker
