// SPDX-License-Identifier: BSD-3-Clause
#include "support/temporary_folder.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace chain_tracker {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() : folder_((fs::temp_directory_path() / "testXXXXXX").string()) {
  if (mkdtemp(folder_.data()) == nullptr) throw std::runtime_error(folder_ + " cannot be made");
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code error;
  fs::remove_all(folder_, error);
}

void TemporaryFolder::write(const std::string& name, const std::string& text) const {
  std::ofstream(path(name)) << text;
}

std::string TemporaryFolder::read(const std::string& name) const {
  std::ifstream file(path(name));
  return {std::istreambuf_iterator<char>(file), {}};
}

size_t TemporaryFolder::files() const {
  return static_cast<size_t>(
      std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
}

}  // namespace chain_tracker
