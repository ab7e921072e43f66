// SPDX-License-Identifier: BSD-3-Clause
#include "tap_shape.h"

#include <algorithm>
#include <cstdlib>
#include <map>

namespace chain_tracker::haar {
namespace {

/// Weights larger than this are multiplied one by one.
constexpr int kLargestCommon = 8;

int commonWeight(const std::vector<RowTap>& taps) {
  std::map<int, int> counts;
  for (const RowTap& tap : taps) {
    const bool is_small = tap.weight >= -kLargestCommon && tap.weight <= kLargestCommon;
    if (is_small && std::abs(tap.weight) > 1) ++counts[std::abs(tap.weight)];
  }
  int common = 0;
  int most = 0;
  for (const auto& [weight, count] : counts) {
    if (count > most) {
      common = weight;
      most = count;
    }
  }
  return common;
}

}  // namespace

int TapShape::taps() const { return plus + minus + common_plus + common_minus + other; }

bool TapShape::operator==(const TapShape& shape) const {
  return plus == shape.plus && minus == shape.minus && common_plus == shape.common_plus &&
         common_minus == shape.common_minus && common == shape.common && other == shape.other;
}

TapShape groupTaps(std::vector<RowTap>& taps) {
  TapShape shape;
  shape.common = commonWeight(taps);
  const auto rank = [&shape](const RowTap& tap) {
    if (tap.weight == 1) return 0;
    if (tap.weight == -1) return 1;
    if (tap.weight == shape.common) return 2;
    return tap.weight == -shape.common ? 3 : 4;
  };
  std::stable_sort(taps.begin(), taps.end(),
                   [&rank](const RowTap& a, const RowTap& b) { return rank(a) < rank(b); });
  const auto count = [&](int wanted) {
    return static_cast<int>(std::count_if(taps.begin(), taps.end(),
                                          [&](const RowTap& tap) { return rank(tap) == wanted; }));
  };
  shape.plus = count(0);
  shape.minus = count(1);
  shape.common_plus = count(2);
  shape.common_minus = count(3);
  shape.other = count(4);
  return shape;
}

}  // namespace chain_tracker::haar
