// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <yaml-cpp/yaml.h>

namespace chain_tracker {

/// All of a file. `kind`: of the file, in the error: std::invalid_argument naming it and its
/// absolute path if it cannot be read.
std::string textOfFile(const std::string& path, const std::string& kind);

/// The one YAML document in a text; `source` stands for the file's name in errors.
/// Throws std::invalid_argument naming source and line if it is no YAML or a second one begins.
YAML::Node parseYamlDocument(const std::string& yaml, const std::string& source);

}  // namespace chain_tracker
