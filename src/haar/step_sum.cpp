// SPDX-License-Identifier: BSD-3-Clause
#include "step_sum.h"

#include <algorithm>

#include "cache_size.h"

namespace chain_tracker::haar {

size_t cachedPlanes(const cv::Size& size, size_t planes) {
  const size_t plane_bytes = static_cast<size_t>(std::max(1, size.area())) * sizeof(std::int32_t);
  if (planes * plane_bytes > lastCacheBytes()) return 0;
  // The other half is for whoever else uses the cache.
  return std::min(planes, lastCacheBytes() / 2 / plane_bytes);
}

RowKind rowKindOf(const PlanStep& step, const PlanBuffer& source) {
  if (step.lane == Lane::k16) {
    if (step.target >= 0) return RowKind::k16To16;
    return step.is_signed ? RowKind::k16To32Signed : RowKind::k16To32Unsigned;
  }
  if (source.lane == Lane::k32) return RowKind::k32To32;
  return source.is_signed ? RowKind::kSigned16To32 : RowKind::kUnsigned16To32;
}

std::vector<RowTap> tapsOf(const PlanStep& step) {
  std::vector<RowTap> taps;
  for (const PlanInput& input : step.inputs) taps.push_back({input.dx, input.dy, input.weight});
  return taps;
}

}  // namespace chain_tracker::haar
