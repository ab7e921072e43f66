// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/haar/double_difference.h"

#include <map>

namespace chain_tracker::haar {
namespace {

/// Running sums of weights along a line of taps, kept between `run` and the next change: the sums
/// of the positive and of the negative values that the integrated line takes.
struct LineSums {
  std::int64_t positive = 0;
  std::int64_t negative = 0;
};

/// Integrates weights by place; nothing if the sum does not return to zero.
std::optional<LineSums> integrate(const std::map<int, std::int64_t>& weights) {
  LineSums sums;
  std::int64_t value = 0;
  int place = 0;
  for (const auto& [next, weight] : weights) {
    const std::int64_t area = value * (next - place);
    (area > 0 ? sums.positive : sums.negative) += area;
    value += weight;
    place = next;
  }
  if (value != 0) return std::nullopt;
  return sums;
}

}  // namespace

SparseKernel doubleDifference(const HaarFeature& feature) {
  std::vector<KernelTap> taps;
  for (const WeightedRectangle& r : feature.rectangles) {
    const int right = -(r.x + r.width - 1);
    const int bottom = -(r.y + r.height - 1);
    taps.push_back({bottom, right, r.weight});
    taps.push_back({bottom, right + r.width, -r.weight});
    taps.push_back({bottom + r.height, right, -r.weight});
    taps.push_back({bottom + r.height, right + r.width, r.weight});
  }
  return SparseKernel(std::move(taps));
}

std::optional<ValueRange> rangeOnImage(const SparseKernel& kernel, int max_pixel) {
  ValueRange range;
  std::map<int, std::int64_t> row;  // the kernel summed over the rows so far, by column
  const std::vector<KernelTap>& taps = kernel.taps();
  for (size_t i = 0; i < taps.size();) {
    const int dy = taps[i].dy;
    for (; i < taps.size() && taps[i].dy == dy; ++i) {
      const auto entry = row.try_emplace(taps[i].dx, 0).first;
      entry->second += taps[i].weight;
      if (entry->second == 0) row.erase(entry);
    }
    const std::optional<LineSums> sums = integrate(row);
    if (!sums) return std::nullopt;
    const std::int64_t rows = i < taps.size() ? taps[i].dy - dy : 0;
    range.low += sums->negative * rows * max_pixel;
    range.high += sums->positive * rows * max_pixel;
  }
  if (!row.empty()) return std::nullopt;
  return range;
}

}  // namespace chain_tracker::haar
