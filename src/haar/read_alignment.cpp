// SPDX-License-Identifier: BSD-3-Clause
#include "read_alignment.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

namespace chain_tracker::haar {
namespace {

std::uint64_t keyOf(const cv::Point& point) {
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(point.y)) << 32U) |
         static_cast<std::uint32_t>(point.x);
}

cv::Point pointOf(std::uint64_t key) {
  return {static_cast<int>(static_cast<std::uint32_t>(key)), static_cast<int>(key >> 32U)};
}

/// A better alignment than a known one, if there is one.
class AlignmentSearch {
 public:
  AlignmentSearch(const std::vector<Support>& supports, ReadAlignment known, int max_steps)
      : supports_(supports),
        best_(std::move(known)),
        shifts_(supports.size()),
        is_placed_(supports.size(), false),
        steps_left_(max_steps) {
    const auto largest =
        std::max_element(supports.begin(), supports.end(),
                         [](const Support& a, const Support& b) { return a.size() < b.size(); });
    least_ = static_cast<int>(largest->size());
    place(static_cast<size_t>(largest - supports.begin()), {}, {});
    best_.is_proven = steps_left_ > 0;
  }

  const ReadAlignment& best() const { return best_; }

 private:
  using Points = std::set<std::uint64_t>;

  void place(size_t index, const cv::Point& shift, const Points& before) {
    --steps_left_;
    auto size = static_cast<int>(before.size());
    for (const cv::Point& point : supports_[index]) {
      size += 1 - static_cast<int>(before.count(keyOf(point + shift)));
    }
    if (size >= best_.reads) return;
    Points reads = before;
    for (const cv::Point& point : supports_[index]) reads.insert(keyOf(point + shift));
    is_placed_[index] = true;
    shifts_[index] = shift;
    if (visited_.emplace(is_placed_, reads).second) continueFrom(reads);
    is_placed_[index] = false;
  }

  void continueFrom(const Points& reads) {
    bool is_complete = true;
    for (size_t i = 0; i < supports_.size(); ++i) {
      if (is_placed_[i]) continue;
      is_complete = false;
      std::set<std::uint64_t> shifts;
      for (const std::uint64_t read : reads) {
        for (const cv::Point& point : supports_[i]) shifts.insert(keyOf(pointOf(read) - point));
      }
      for (const std::uint64_t shift : shifts) {
        if (best_.reads == least_ || steps_left_ <= 0) return;
        place(i, pointOf(shift), reads);
      }
    }
    if (is_complete) {
      best_.reads = static_cast<int>(reads.size());
      best_.shifts = shifts_;
    }
  }

  const std::vector<Support>& supports_;
  ReadAlignment best_;
  std::vector<cv::Point> shifts_;
  std::vector<bool> is_placed_;
  std::set<std::pair<std::vector<bool>, Points>> visited_;
  int steps_left_;
  int least_ = 0;
};

ReadAlignment alignGreedily(const std::vector<Support>& supports) {
  ReadAlignment alignment;
  alignment.shifts.resize(supports.size());
  std::vector<size_t> order(supports.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return supports[a].size() > supports[b].size(); });
  ReadSet reads;
  for (const size_t index : order) {
    alignment.shifts[index] = reads.bestPlacement(supports[index]).shift;
    reads.add(supports[index], alignment.shifts[index]);
  }
  alignment.reads = reads.size();
  return alignment;
}

}  // namespace

Support supportOf(const SparseKernel& kernel) {
  Support support;
  for (const KernelTap& tap : kernel.taps()) support.emplace_back(tap.dx, tap.dy);
  return support;
}

ReadSet::Placement ReadSet::bestPlacement(const Support& support, std::uint32_t tie_breaker) const {
  std::unordered_map<std::uint64_t, int> shared;
  int most = 0;
  for (const auto& read : counts_) {
    for (const cv::Point& point : support) {
      most = std::max(most, ++shared[keyOf(pointOf(read.first) - point)]);
    }
  }
  std::vector<std::uint64_t> shifts;
  for (const auto& entry : shared) {
    if (entry.second == most) shifts.push_back(entry.first);
  }
  if (shifts.empty()) return {{}, static_cast<int>(support.size())};
  // Hash tables have no order of their own.
  std::sort(shifts.begin(), shifts.end());
  return {pointOf(shifts[tie_breaker % shifts.size()]), static_cast<int>(support.size()) - most};
}

void ReadSet::add(const Support& support, const cv::Point& shift) {
  for (const cv::Point& point : support) ++counts_[keyOf(point + shift)];
}

void ReadSet::remove(const Support& support, const cv::Point& shift) {
  for (const cv::Point& point : support) {
    const auto entry = counts_.find(keyOf(point + shift));
    if (--entry->second == 0) counts_.erase(entry);
  }
}

ReadAlignment alignReads(const std::vector<Support>& supports, int max_steps) {
  const ReadAlignment greedy = alignGreedily(supports);
  return AlignmentSearch(supports, greedy, max_steps).best();
}

}  // namespace chain_tracker::haar
