// SPDX-License-Identifier: BSD-3-Clause
/// Where the buffers of a plan keep their last rows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "chain_tracker/haar/convolution_plan.h"
#include "plan_loops.h"
#include "row_sums.h"

namespace chain_tracker::haar {

/// Of all rows [bytes].
constexpr size_t kRowAlignment = 64;

/// The last rows of a buffer. Column 0 of all rings is the same column of the image; `margin`
/// columns before it can be read, but mean nothing.
class RowRing {
 public:
  RowRing(Lane lane, int rows, int columns, int margin);

  void* at(int row, int column) const {
    return first_ + ((row & mask_) * stride_ + column) * static_cast<std::ptrdiff_t>(element_size_);
  }
  RowStore store() const { return {first_, mask_, stride_}; }
  std::ptrdiff_t stride() const { return stride_; }
  size_t bytes() const { return memory_.size(); }

 private:
  size_t element_size_;
  int mask_;
  std::ptrdiff_t stride_;
  std::vector<std::uint8_t> memory_;
  std::uint8_t* first_;
};

/// For every buffer, the first one that uses the same ring: itself, unless rings are shared. What
/// is passed on can follow one another in one ring, so that it stays in the nearest cache.
std::vector<size_t> ringOwners(const ConvolutionPlan& plan, const std::vector<PlanLoop>& loops,
                               bool may_share);

}  // namespace chain_tracker::haar
