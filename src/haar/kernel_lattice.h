// SPDX-License-Identifier: BSD-3-Clause
/// The kernels that trees of an ensemble are made of, and which divides which.
#pragma once

#include <map>
#include <unordered_map>
#include <vector>

#include "chain_tracker/haar/sparse_kernel.h"
#include "read_alignment.h"

namespace chain_tracker::haar {

/// Kernels are known by numbers; 0 is the kernel 1, the integral image itself.
class KernelLattice {
 public:
  /// Of different primitive kernels; `factor` off: without their divisors.
  KernelLattice(const std::vector<SparseKernel>& targets, bool factor);

  int size() const { return static_cast<int>(kernels_.size()); }
  const SparseKernel& kernel(int id) const { return kernels_[static_cast<size_t>(id)]; }
  /// Numbers of the targets, in the order given.
  const std::vector<int>& targets() const { return targets_; }
  /// Proper divisors of a target, by its place in targets().
  const std::vector<int>& divisors(size_t target) const { return divisors_[target]; }

  /// What turns the parent into the child; null if the parent does not divide it or is it.
  struct Edge {
    SparseKernel kernel;
    Support support;
    int ring_rows = 1;  ///< rows of the parent that must be kept
  };
  const Edge* edge(int child, int parent) const;

 private:
  int idOf(const SparseKernel& kernel);

  std::vector<SparseKernel> kernels_;
  std::map<SparseKernel, int> ids_;
  std::vector<int> targets_;
  std::vector<std::vector<int>> divisors_;
  mutable std::unordered_map<std::uint64_t, Edge> edges_;  ///< computed when asked for
};

}  // namespace chain_tracker::haar
