// SPDX-License-Identifier: BSD-3-Clause
#include "loop_timings.h"

#include <cmath>
#include <exception>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <utility>

#include <yaml-cpp/yaml.h>

namespace chain_tracker::haar {
namespace {

constexpr char kMachine[] = "machine";
constexpr char kSeconds[] = "seconds";

std::map<std::string, double> readTimings(const std::string& file, const std::string& machine) {
  std::map<std::string, double> timings;
  const YAML::Node document = YAML::LoadFile(file);
  if (document[kMachine].as<std::string>() != machine) return timings;
  for (const auto& entry : document[kSeconds]) {
    const auto seconds = entry.second.as<double>();
    if (std::isfinite(seconds) && seconds > 0.0) timings[entry.first.as<std::string>()] = seconds;
  }
  return timings;
}

std::string textOf(const std::map<std::string, double>& timings, const std::string& machine) {
  YAML::Emitter text;
  text.SetDoublePrecision(std::numeric_limits<double>::max_digits10);
  text << YAML::BeginMap << YAML::Key << kMachine << YAML::Value << machine;
  text << YAML::Key << kSeconds << YAML::Value << timings << YAML::EndMap;
  return text.c_str();
}

}  // namespace

LoopTimings::LoopTimings(std::string file, std::string machine)
    : file_(std::move(file)), machine_(std::move(machine)) {
  if (file_.empty()) return;
  try {
    seconds_ = readTimings(file_, machine_);
  } catch (const std::exception&) {  // of YAML, or of the stream
    // As if there were none: it is measured anew, and replaced.
  }
}

std::optional<double> LoopTimings::find(const std::string& loop) const {
  const auto found = seconds_.find(loop);
  return found == seconds_.end() ? std::nullopt : std::optional<double>(found->second);
}

bool LoopTimings::save() const {
  namespace fs = std::filesystem;
  if (file_.empty()) return false;
  std::error_code error;
  fs::create_directories(fs::path(file_).parent_path(), error);
  const std::string draft = file_ + "." + std::to_string(std::random_device()());
  std::ofstream stream(draft);
  stream << textOf(seconds_, machine_) << "\n";
  stream.close();
  if (stream) {
    fs::rename(draft, file_, error);
    if (!error) return true;
  }
  fs::remove(draft, error);
  return false;
}

}  // namespace chain_tracker::haar
