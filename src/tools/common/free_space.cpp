// SPDX-License-Identifier: BSD-3-Clause
#include "free_space.h"

#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace chain_tracker {
namespace {

namespace fs = std::filesystem;

std::string inMegabytes(std::uintmax_t bytes) { return std::to_string(bytes / 1'000'000) + " MB"; }

}  // namespace

void requireSpace(const std::string& file, std::uintmax_t bytes) {
  std::error_code no_folder;  // which writing the file will tell of
  const fs::space_info space = fs::space(fs::absolute(file).parent_path(), no_folder);
  if (no_folder || bytes <= space.available) return;
  throw std::invalid_argument(file + " would be " + inMegabytes(bytes) + ", must be at most the " +
                              inMegabytes(space.available) + " that its disk has left");
}

}  // namespace chain_tracker
