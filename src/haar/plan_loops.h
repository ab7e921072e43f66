// SPDX-License-Identifier: BSD-3-Clause
/// The loops that a plan is run with on this machine. Where a chain of passes is separable and the
/// machine has a loop for that, the chain becomes one loop, which keeps what the passes hand on in
/// registers.
#pragma once

#include <vector>

#include "chain_tracker/haar/convolution_plan.h"
#include "row_sums.h"

namespace chain_tracker::haar {

/// As PlanStep.
struct PlanLoop {
  int source = 0;
  int target = -1;
  int feature = -1;
  cv::Point advance;
  RowKind kind = RowKind::k32To32;
  SeparableTaps taps;  ///< all of them a column's, if the loop is not one for separable taps
  RowSum sum;
};

/// Buffers of which no earlier rows are read: what is handed on from pass to pass.
bool isPassing(const PlanBuffer& buffer);

/// In the order in which they run; buffers that no loop reads are not written.
std::vector<PlanLoop> loopsOf(const ConvolutionPlan& plan, InstructionSet instructions);

}  // namespace chain_tracker::haar
