// SPDX-License-Identifier: BSD-3-Clause
/// Measurements of loops, kept in a file from one process to the next.
#pragma once

#include <map>
#include <optional>
#include <string>

namespace chain_tracker::haar {

/// A file keeps those of one machine: another one's say nothing about this one. The file only saves
/// time, so nothing that is wrong with it is an error.
class LoopTimings {
 public:
  /// Reads the file, unless its name is empty. What cannot be read, or is another machine's, is
  /// left out.
  LoopTimings(std::string file, std::string machine);

  std::optional<double> find(const std::string& loop) const;
  void set(const std::string& loop, double seconds) { seconds_[loop] = seconds; }
  void clear() { seconds_.clear(); }

  /// Replaces the file as a whole: others find the old one or the new one. False if it cannot be
  /// written, or if its name is empty.
  bool save() const;

 private:
  std::string file_;
  std::string machine_;
  std::map<std::string, double> seconds_;
};

}  // namespace chain_tracker::haar
