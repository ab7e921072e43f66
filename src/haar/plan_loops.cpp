// SPDX-License-Identifier: BSD-3-Clause
#include "plan_loops.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "separable_taps.h"
#include "step_sum.h"

namespace chain_tracker::haar {
namespace {

SparseKernel kernelOf(const PlanStep& step) {
  std::vector<KernelTap> taps;
  for (const PlanInput& input : step.inputs) taps.push_back({input.dy, input.dx, input.weight});
  return SparseKernel(taps);
}

/// The step that writes each buffer; null for the integral image.
std::vector<const PlanStep*> writersOf(const ConvolutionPlan& plan) {
  std::vector<const PlanStep*> writers(plan.buffers().size(), nullptr);
  for (const PlanStep& step : plan.steps()) {
    if (step.target >= 0) writers[static_cast<size_t>(step.target)] = &step;
  }
  return writers;
}

class LoopChoice {
 public:
  LoopChoice(const ConvolutionPlan& plan, InstructionSet instructions)
      : plan_(plan), instructions_(instructions), writers_(writersOf(plan)) {}

  /// The step together with as many as possible of those that pass their sums on to it.
  PlanLoop loopOf(const PlanStep& step) const {
    const RowKind kind = rowKindOf(step, buffer(step.source));
    const std::vector<RowTap> taps = tapsOf(step);
    PlanLoop loop{step.source,
                  step.target,
                  step.feature,
                  step.advance,
                  kind,
                  {taps, {}},
                  RowSum(kind, taps, instructions_)};
    // Sums modulo 2^16 may be taken over passes, whatever these pass on.
    if (step.lane != Lane::k16) return loop;
    SparseKernel kernel = kernelOf(step);
    for (int source = step.source;;) {
      takeSeparable(loop, kernel, source);
      if (!isPassing(buffer(source))) return loop;
      const PlanStep& writer = *writers_[static_cast<size_t>(source)];
      kernel = kernel * kernelOf(writer);
      source = writer.source;
    }
  }

 private:
  const PlanBuffer& buffer(int index) const { return plan_.buffers()[static_cast<size_t>(index)]; }

  void takeSeparable(PlanLoop& loop, const SparseKernel& kernel, int source) const {
    const std::optional<SeparableTaps> taps = separableTaps(kernel);
    if (!taps) return;
    std::optional<RowSum> sum = RowSum::ofSeparable(loop.kind, *taps, instructions_);
    if (!sum) return;
    loop.source = source;
    loop.taps = *taps;
    loop.sum = *std::move(sum);
  }

  const ConvolutionPlan& plan_;
  InstructionSet instructions_;
  std::vector<const PlanStep*> writers_;
};

}  // namespace

bool isPassing(const PlanBuffer& buffer) { return buffer.node != 0 && buffer.delays == 0; }

std::vector<PlanLoop> loopsOf(const ConvolutionPlan& plan, InstructionSet instructions) {
  const LoopChoice choice(plan, instructions);
  std::vector<bool> is_read(plan.buffers().size(), false);
  std::vector<PlanLoop> loops;
  for (auto step = plan.steps().rbegin(); step != plan.steps().rend(); ++step) {
    if (step->target >= 0 && !is_read[static_cast<size_t>(step->target)]) continue;
    loops.push_back(choice.loopOf(*step));
    is_read[static_cast<size_t>(loops.back().source)] = true;
  }
  std::reverse(loops.begin(), loops.end());
  return loops;
}

}  // namespace chain_tracker::haar
