// SPDX-License-Identifier: BSD-3-Clause
#include "part_overlaps.h"

#include <algorithm>

namespace chain_tracker {
namespace {

/// Windows see much the same whose centres are nearer, of the smaller one's side.
constexpr double kNear = 0.5;

bool isNear(const PartState& a, const PartState& b) {
  return cv::norm(a.position - b.position) < kNear * std::min(a.side, b.side);
}

}  // namespace

PartOverlaps::PartOverlaps(const std::vector<PartState>& initial) {
  for (size_t a = 0; a < initial.size(); ++a) {
    for (size_t b = 0; b < a; ++b) {
      if (!isNear(initial[a], initial[b])) apart_.emplace_back(a, b);
    }
  }
}

void PartOverlaps::computeShares(const std::vector<PartState>& parts,
                                 std::vector<double>& shares) const {
  shares.assign(parts.size(), 1.0);
  for (const auto& [a, b] : apart_) {
    if (!isNear(parts[a], parts[b])) continue;
    ++shares[a];
    ++shares[b];
  }
  for (double& share : shares) share = 1.0 / share;
}

}  // namespace chain_tracker
