// SPDX-License-Identifier: BSD-3-Clause
#include "text_files.h"

#include <fstream>
#include <stdexcept>

namespace chain_tracker {

void writeText(const std::string& path, const std::string& content) {
  std::ofstream file(path);
  file << content;
  file.close();
  if (!file) throw std::runtime_error(path + " cannot be written");
}

void writeJson(const std::string& path, const nlohmann::json& content) {
  writeText(path, content.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace chain_tracker
