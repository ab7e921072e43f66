// SPDX-License-Identifier: BSD-3-Clause
#include "pass_reads.h"

#include <algorithm>

namespace chain_tracker::haar {
namespace {

/// Of one question to unionWithin().
constexpr std::int64_t kMaxWork = 300000;

}  // namespace

int PassReads::idOf(const Support& support) {
  std::vector<std::pair<int, int>> key;
  for (const cv::Point& point : support) key.emplace_back(point.y, point.x);
  const auto [entry, is_new] = ids_.try_emplace(key, static_cast<int>(supports_.size()));
  if (is_new) supports_.push_back(support);
  return entry->second;
}

int PassReads::overlap(int a, int b) {
  const size_t low = static_cast<size_t>(std::min(a, b));
  const size_t high = static_cast<size_t>(std::max(a, b));
  overlaps_.resize(std::max(overlaps_.size(), high + 1));
  std::vector<int>& row = overlaps_[high];
  row.resize(std::max(row.size(), high + 1), 0);
  if (row[low] == 0) {
    ReadSet reads;
    reads.add(support(a), {});
    row[low] = size(b) - reads.bestPlacement(support(b)).new_reads;
  }
  return row[low];
}

bool PassReads::mayFit(std::vector<int> pass, int most) {
  std::sort(pass.begin(), pass.end());
  pass.erase(std::unique(pass.begin(), pass.end()), pass.end());
  Known& known = known_[pass];
  if (most <= known.too_few) return false;
  if (known.enough != 0 && most >= known.enough) return true;
  std::vector<Support> supports;
  supports.reserve(pass.size());
  for (const int id : pass) supports.push_back(support(id));
  const UnionAnswer answer = unionWithin(supports, most, kMaxWork);
  work_ += answer.work;
  (answer.is_possible ? known.enough : known.too_few) = most;
  return answer.is_possible;
}

int PassReads::least(const std::vector<int>& pass) {
  int reads = 0;
  for (const int id : pass) reads = std::max(reads, size(id));
  while (!mayFit(pass, reads)) ++reads;
  return reads;
}

}  // namespace chain_tracker::haar
