// SPDX-License-Identifier: BSD-3-Clause
#include "yaml/yaml_document.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace chain_tracker {
namespace {

/// Line at which a second document begins; 0 if there is one at most.
int lineOfSecondDocument(const std::string& yaml) {
  std::istringstream lines(yaml);
  std::string line;
  bool has_content = false;
  for (int number = 1; std::getline(lines, line); ++number) {
    const bool is_separator = line.compare(0, 3, "---") == 0;
    if (is_separator && has_content) return number;
    has_content = has_content || is_separator || (!line.empty() && line.front() != '#');
  }
  return 0;
}

}  // namespace

// Not with YAML::LoadAll(), which never returns from some texts that are no YAML.
YAML::Node parseYamlDocument(const std::string& yaml, const std::string& source) {
  const int second = lineOfSecondDocument(yaml);
  if (second > 0) {
    throw std::invalid_argument(source + ":" + std::to_string(second) +
                                ": a second YAML document begins, must be one");
  }
  try {
    return YAML::Load(yaml);
  } catch (const YAML::Exception& error) {
    throw std::invalid_argument(source + ":" + std::to_string(std::max(0, error.mark.line) + 1) +
                                ": not valid YAML: " + error.msg);
  }
}

}  // namespace chain_tracker
