// SPDX-License-Identifier: BSD-3-Clause
#include "row_rings.h"

#include <numeric>

namespace chain_tracker::haar {
namespace {

int powerOfTwoFrom(int least) {
  int power = 1;
  while (power < least) power *= 2;
  return power;
}

/// The loop after which nobody reads a buffer any more, for every buffer.
std::vector<size_t> lastReads(const ConvolutionPlan& plan, const std::vector<PlanLoop>& loops) {
  std::vector<size_t> last(plan.buffers().size(), 0);
  for (size_t i = 0; i < loops.size(); ++i) last[static_cast<size_t>(loops[i].source)] = i;
  return last;
}

}  // namespace

RowRing::RowRing(Lane lane, int rows, int columns, int margin)
    : element_size_(lane == Lane::k16 ? 2 : 4), mask_(powerOfTwoFrom(rows) - 1) {
  const auto row_bytes = static_cast<size_t>(margin + columns) * element_size_;
  const size_t stride_bytes = (row_bytes + kRowAlignment - 1) / kRowAlignment * kRowAlignment;
  stride_ = static_cast<std::ptrdiff_t>(stride_bytes / element_size_);
  memory_.resize(stride_bytes * (static_cast<size_t>(mask_) + 1) + kRowAlignment +
                 kTouchedColumns * element_size_);
  const auto address = reinterpret_cast<std::uintptr_t>(memory_.data());
  first_ = memory_.data() + (kRowAlignment - address % kRowAlignment) % kRowAlignment +
           static_cast<size_t>(margin) * element_size_;
}

std::vector<size_t> ringOwners(const ConvolutionPlan& plan, const std::vector<PlanLoop>& loops,
                               bool may_share) {
  const std::vector<PlanBuffer>& buffers = plan.buffers();
  std::vector<size_t> owners(buffers.size());
  std::iota(owners.begin(), owners.end(), size_t{0});
  if (!may_share) return owners;
  const std::vector<size_t> last_reads = lastReads(plan, loops);
  std::vector<size_t> busy_until = last_reads;  // of the rings
  std::vector<bool> is_ring(buffers.size(), false);
  for (size_t i = 0; i < loops.size(); ++i) {
    if (loops[i].target < 0) continue;
    const auto target = static_cast<size_t>(loops[i].target);
    const auto can_take = [&](size_t ring) {
      return is_ring[ring] && isPassing(buffers[ring]) && isPassing(buffers[target]) &&
             buffers[ring].lane == buffers[target].lane && busy_until[ring] < i;
    };
    for (size_t ring = 0; ring < target && owners[target] == target; ++ring) {
      if (can_take(ring)) owners[target] = ring;
    }
    is_ring[owners[target]] = true;
    busy_until[owners[target]] = last_reads[target];
  }
  return owners;
}

}  // namespace chain_tracker::haar
