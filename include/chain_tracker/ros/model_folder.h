// SPDX-License-Identifier: BSD-3-Clause
/// Models by name: the YAML files of one folder.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_model.h"

namespace chain_tracker {

class ModelFolder {
 public:
  explicit ModelFolder(std::string path) : path_(std::move(path)) {}

  /// The folder of the models that come with this package, or "" if the package is not found.
  static std::string ofThisPackage();

  /// Names of the models in the folder, in alphabetical order.
  std::vector<std::string> names() const;

  /// The model of that name, or in that file if it ends in ".yaml".
  /// Throws std::invalid_argument: an unknown name, with the names there are, or a faulty file.
  ChainModel load(const std::string& name_or_file) const;

  /// The same, "auto" standing for the model that the shape given asks for: of this folder, or of
  /// this package where the folder has none of that name. Models by name, but not files, get fewer
  /// parts where the shape has no room for theirs (auto_model.h).
  ChainModel loadFor(const std::vector<cv::Point2d>& points, const std::string& name_or_file) const;

  /// The model of that name as "auto" takes it.
  ChainModel loadForAuto(const std::vector<cv::Point2d>& points, const std::string& name) const;

 private:
  bool has(const std::string& name) const;

  std::string path_;
};

}  // namespace chain_tracker
