// SPDX-License-Identifier: BSD-3-Clause
#include "yaml/yaml_document.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace chain_tracker {
namespace {

bool isSeparator(const std::string& line) {
  return line.compare(0, 3, "---") == 0 && (line.size() == 3 || std::isspace(line[3]) != 0);
}

bool isBlankOrComment(const std::string& line) {
  const auto first = line.find_first_not_of(" \t\r");
  return first == std::string::npos || line[first] == '#';
}

/// Line at which a second document begins; 0 if there is one at most.
int lineOfSecondDocument(const std::string& yaml) {
  std::istringstream lines(yaml);
  std::string line;
  bool has_begun = false;
  bool has_ended = false;
  for (int number = 1; std::getline(lines, line); ++number) {
    const bool is_directive = !has_begun && line.compare(0, 1, "%") == 0;
    if (is_directive || isBlankOrComment(line)) continue;
    if (has_ended || (has_begun && isSeparator(line))) return number;
    has_begun = true;
    has_ended = line.compare(0, 3, "...") == 0;
  }
  return 0;
}

}  // namespace

std::string textOfFile(const std::string& path, const std::string& kind) {
  std::ifstream file(path);
  if (!file || std::filesystem::is_directory(path)) {
    throw std::invalid_argument(kind + " file " + std::filesystem::absolute(path).string() +
                                " cannot be read");
  }
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

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
