// SPDX-License-Identifier: BSD-3-Clause
#include "kernel_lattice.h"

#include "kernel_factors.h"

namespace chain_tracker::haar {

KernelLattice::KernelLattice(const std::vector<SparseKernel>& targets, bool factor) {
  idOf(SparseKernel::one());
  for (const SparseKernel& target : targets) targets_.push_back(idOf(target));
  divisors_.resize(targets.size());
  if (!factor) return;
  DifferenceDelays delays;
  for (const SparseKernel& target : targets) {
    DifferenceDelays more = differenceDelays(target);
    delays.x.merge(more.x);
    delays.y.merge(more.y);
  }
  for (size_t i = 0; i < targets.size(); ++i) {
    for (const SparseKernel& divisor : properDivisors(targets[i], delays)) {
      divisors_[i].push_back(idOf(divisor));
    }
  }
}

int KernelLattice::idOf(const SparseKernel& kernel) {
  const auto [entry, is_new] = ids_.try_emplace(kernel, size());
  if (is_new) kernels_.push_back(kernel);
  return entry->second;
}

const KernelLattice::Edge* KernelLattice::edge(int child, int parent) const {
  if (child == parent) return nullptr;
  const std::uint64_t key =
      (static_cast<std::uint64_t>(child) << 32U) | static_cast<std::uint32_t>(parent);
  const auto [entry, is_new] = edges_.try_emplace(key);
  Edge& edge = entry->second;
  if (is_new) {
    if (const auto quotient = kernel(child).dividedBy(kernel(parent))) {
      edge.kernel = *quotient;
      edge.support = supportOf(edge.kernel);
      edge.ring_rows = edge.kernel.maxDelay().y + 1;
    }
  }
  return edge.kernel.isZero() ? nullptr : &edge;
}

}  // namespace chain_tracker::haar
