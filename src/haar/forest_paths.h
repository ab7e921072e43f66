// SPDX-License-Identifier: BSD-3-Clause
/// What the best trees are made of.
///
/// A kernel that divides only one target has one child in a best tree, for whatever hangs on it
/// leads to that target. So a tree consists of junctions - the targets, the kernels that divide
/// several targets, the integral image - and of paths of other kernels between them. Only the first
/// pass of a path, over the junction above, can share reads; the rest, its tail, has a cost of its
/// own, the same in every tree.
#pragma once

#include <vector>

#include "kernel_lattice.h"
#include "pass_reads.h"

namespace chain_tracker::haar {

/// One way from a junction up to another.
struct ForestPath {
  int above = 0;  ///< junction that it hangs on
  int first = 0;  ///< kernel that is computed from `above`
  int reads = 0;  ///< what that pass reads for it: a number of PassReads
  int tail = 0;   ///< reads and writes from the first kernel on
};

/// Junctions are known by numbers: the larger kernels first, the integral image last.
class ForestPaths {
 public:
  ForestPaths(const KernelLattice& lattice, PassReads& reads);

  int size() const { return static_cast<int>(junctions_.size()); }
  int root() const { return size() - 1; }
  int kernel(int junction) const { return junctions_[static_cast<size_t>(junction)]; }
  bool isTarget(int junction) const { return target_uses_[indexOf(kernel(junction))].is_target; }
  /// Those that a best tree may need: no path that reads more for the same or a longer tail.
  /// Ordered by what they hang on.
  const std::vector<ForestPath>& above(int junction) const {
    return paths_[static_cast<size_t>(junction)];
  }
  /// The kernels of a path to a junction, from its first one to the junction's own.
  std::vector<int> kernelsOf(const ForestPath& path, int junction) const;

 private:
  struct TargetUse {
    bool is_target = false;
    int targets = 0;  ///< that the kernel divides or is
    int target = 0;   ///< one of them
  };

  static size_t indexOf(int kernel) { return static_cast<size_t>(kernel); }
  void countTargets();
  void findTails();
  void addPaths(int junction, PassReads& reads);

  const KernelLattice* lattice_;
  std::vector<int> by_size_;            ///< all kernels, the larger first
  std::vector<TargetUse> target_uses_;  ///< by kernel
  std::vector<int> tails_;              ///< of kernels between junctions, by kernel
  std::vector<int> next_;               ///< the kernel after it on its tail, by kernel
  std::vector<std::vector<int>> own_;   ///< kernels between junctions by the target they divide
  std::vector<int> junctions_;
  std::vector<std::vector<ForestPath>> paths_;
};

}  // namespace chain_tracker::haar
