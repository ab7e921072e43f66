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

/// How many of the points of a support are in a set of points, by shift; only shifts at which there
/// are any, in the order of their keys.
std::vector<std::pair<std::uint64_t, int>> meetings(const std::vector<std::uint64_t>& points,
                                                    const Support& support) {
  std::vector<std::uint64_t> shifts;
  shifts.reserve(points.size() * support.size());
  for (const std::uint64_t point : points) {
    for (const cv::Point& own : support) shifts.push_back(keyOf(pointOf(point) - own));
  }
  std::sort(shifts.begin(), shifts.end());
  std::vector<std::pair<std::uint64_t, int>> counts;
  for (const std::uint64_t shift : shifts) {
    if (counts.empty() || counts.back().first != shift) counts.emplace_back(shift, 0);
    ++counts.back().second;
  }
  return counts;
}

/// Whether supports can be shifted so that their union has at most `most` points.
class UnionSearch {
 public:
  UnionSearch(const std::vector<Support>& supports, int most, std::int64_t max_work)
      : supports_(supports), most_(most), max_work_(max_work), shifts_(supports.size()) {}

  UnionAnswer run() {
    std::vector<size_t> rest(supports_.size());
    std::iota(rest.begin(), rest.end(), size_t{0});
    const auto largest = std::max_element(rest.begin(), rest.end(), [&](size_t a, size_t b) {
      return supports_[a].size() < supports_[b].size();
    });
    const bool found = placeAt({}, *largest, {}, rest);
    if (found) return {true, shifts_, work_};
    return {hasGivenUp(), {}, work_};
  }

 private:
  using Points = std::vector<std::uint64_t>;  ///< sorted

  /// A support that is not placed yet, and what it shares with the points at each shift.
  struct Candidate {
    size_t index = 0;
    std::vector<std::pair<std::uint64_t, int>> shared;
    size_t shifts = 0;  ///< at which it adds no more points than are allowed

    int mostShared() const {
      int most = 0;
      for (const auto& entry : shared) most = std::max(most, entry.second);
      return most;
    }
  };

  bool hasGivenUp() const { return work_ >= max_work_; }
  int sizeOf(size_t index) const { return static_cast<int>(supports_[index].size()); }

  bool placeAt(const Points& before, size_t index, const cv::Point& shift,
               std::vector<size_t> rest) {
    shifts_[index] = shift;
    rest.erase(std::find(rest.begin(), rest.end(), index));
    Points points = before;
    for (const cv::Point& own : supports_[index]) points.push_back(keyOf(own + shift));
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (static_cast<int>(points.size()) > most_) return false;
    return visited_.insert(points).second && placeRest(points, rest);
  }

  bool placeRest(const Points& points, std::vector<size_t> rest) {
    const int allowed = most_ - static_cast<int>(points.size());
    std::vector<Candidate> candidates;
    for (const size_t index : std::vector<size_t>(rest)) {
      work_ += static_cast<std::int64_t>(points.size() * supports_[index].size());
      if (hasGivenUp()) return false;
      Candidate candidate{index, meetings(points, supports_[index]), 0};
      const int new_points = sizeOf(index) - candidate.mostShared();
      if (new_points > allowed) return false;
      if (new_points == 0) {
        shifts_[index] = shiftThatShares(candidate, sizeOf(index));
        rest.erase(std::find(rest.begin(), rest.end(), index));
      } else {
        candidates.push_back(std::move(candidate));
      }
    }
    if (candidates.empty()) return true;
    return tryAll(points, toBranchOn(std::move(candidates), allowed), rest, allowed);
  }

  static cv::Point shiftThatShares(const Candidate& candidate, int points) {
    const auto entry = std::find_if(candidate.shared.begin(), candidate.shared.end(),
                                    [&](const auto& e) { return e.second == points; });
    return pointOf(entry->first);
  }

  /// One support that must meet the points, because it has more points than may be added: the one
  /// with the fewest shifts. If there is none, any support may be the next that meets them.
  std::vector<Candidate> toBranchOn(std::vector<Candidate> candidates, int allowed) const {
    const Candidate* fewest = nullptr;
    for (Candidate& candidate : candidates) {
      const int size = sizeOf(candidate.index);
      if (size <= allowed) continue;
      candidate.shifts = static_cast<size_t>(
          std::count_if(candidate.shared.begin(), candidate.shared.end(),
                        [&](const auto& entry) { return size - entry.second <= allowed; }));
      if (fewest == nullptr || candidate.shifts < fewest->shifts) fewest = &candidate;
    }
    if (fewest == nullptr) return candidates;
    return {*fewest};
  }

  bool tryAll(const Points& points, const std::vector<Candidate>& candidates,
              const std::vector<size_t>& rest, int allowed) {
    for (const Candidate& candidate : candidates) {
      for (const auto& [shift, shared] : candidate.shared) {
        if (sizeOf(candidate.index) - shared > allowed) continue;
        if (placeAt(points, candidate.index, pointOf(shift), rest)) return true;
        if (hasGivenUp()) return false;
      }
    }
    return false;
  }

  const std::vector<Support>& supports_;
  int most_;
  std::int64_t max_work_;
  std::int64_t work_ = 0;
  std::vector<cv::Point> shifts_;
  std::set<Points> visited_;  ///< what they leave to be placed follows from the points
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

UnionAnswer unionWithin(const std::vector<Support>& supports, int most, std::int64_t max_work) {
  return UnionSearch(supports, most, max_work).run();
}

ReadAlignment alignReads(const std::vector<Support>& supports, std::int64_t max_work) {
  ReadAlignment alignment = alignGreedily(supports);
  for (;;) {
    const UnionAnswer fewer = unionWithin(supports, alignment.reads - 1, max_work);
    if (fewer.shifts.empty()) return alignment;
    ReadSet reads;
    for (size_t i = 0; i < supports.size(); ++i) reads.add(supports[i], fewer.shifts[i]);
    alignment.shifts = fewer.shifts;
    alignment.reads = reads.size();
  }
}

}  // namespace chain_tracker::haar
