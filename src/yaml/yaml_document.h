// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <yaml-cpp/yaml.h>

namespace chain_tracker {

/// The one YAML document in a text; `source` stands for the file's name in errors.
/// Throws std::invalid_argument naming source and line if it is no YAML or a second one begins.
YAML::Node parseYamlDocument(const std::string& yaml, const std::string& source);

}  // namespace chain_tracker
