// SPDX-License-Identifier: BSD-3-Clause
#include "support/guarded_map.h"

#include <sstream>

namespace chain_tracker {
namespace {

/// Wider than any block that a routine may process at once [cells].
constexpr int kGuardCells = 40;

}  // namespace

GuardedMap::GuardedMap(const cv::Size& size, float guard)
    : memory_(size.height + 2 * kGuardCells, size.width + 2 * kGuardCells, guard),
      map_(memory_(cv::Rect(cv::Point(kGuardCells, kGuardCells), size))),
      guard_(guard) {}

std::string GuardedMap::damage() const {
  const cv::Rect inside(cv::Point(kGuardCells, kGuardCells), map_.size());
  for (int row = 0; row < memory_.rows; ++row) {
    for (int column = 0; column < memory_.cols; ++column) {
      if (inside.contains({column, row}) || memory_(row, column) == guard_) continue;
      std::ostringstream text;
      text << "the guard at row " << row - inside.y << ", column " << column - inside.x
           << " of the map became " << memory_(row, column);
      return text.str();
    }
  }
  return "";
}

}  // namespace chain_tracker
