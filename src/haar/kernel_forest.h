// SPDX-License-Identifier: BSD-3-Clause
/// A tree under construction: which kernels are nodes, under which parents, at which shifts.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "chain_tracker/haar/pass_tree.h"
#include "kernel_lattice.h"

namespace chain_tracker::haar {

/// Accesses first; among equal ones, few taps of all edges; then few rows kept in line buffers.
struct ForestCost {
  std::int64_t accesses = 0;
  std::int64_t taps = 0;
  std::int64_t ring_rows = 0;

  bool operator<(const ForestCost& other) const {
    return std::tie(accesses, taps, ring_rows) <
           std::tie(other.accesses, other.taps, other.ring_rows);
  }
};

class KernelForest {
 public:
  static constexpr int kAbsent = -1;

  /// `features[i]`: how many features target i of the lattice is. `share_reads`: whether values
  /// that several children of a node read count once.
  KernelForest(const KernelLattice& lattice, const std::vector<int>& features, bool share_reads);

  bool contains(int kernel) const { return kernel == 0 || parent(kernel) != kAbsent; }
  int parent(int kernel) const { return parents_[static_cast<size_t>(kernel)]; }
  /// Kernels in the forest but the integral image, in the order in which they came.
  const std::vector<int>& nodes() const { return nodes_; }
  ForestCost cost() const;

  struct Placement {
    bool possible = false;
    cv::Point shift;
    ForestCost added;
  };
  /// What a kernel costs under a parent in the forest, the writes of its own values not counted.
  Placement placement(int kernel, int parent, std::uint32_t tie_breaker) const;

  void attach(int kernel, int parent, const cv::Point& shift);
  /// Takes a kernel from its parent; what hangs on the kernel stays with it.
  void detach(int kernel);
  /// Detaches a kernel and then all nodes above that nothing needs any more.
  void detachWithDeadEnds(int kernel);

  /// Shifts the children of every node anew if that saves reads.
  void realign();

  /// The tree, with `features` in the order of the ensemble.
  PassTree tree(const std::vector<FeatureNode>& features) const;

 private:
  std::vector<int> children(int kernel) const;
  int ringRows(int kernel) const;
  int readsOf(int kernel) const;

  const KernelLattice* lattice_;
  std::vector<int> nodes_;
  std::vector<int> parents_;  ///< by kernel, as all below
  std::vector<cv::Point> shifts_;
  std::vector<int> child_counts_;
  std::vector<int> features_;
  std::map<int, ReadSet> reads_;  ///< of the nodes that have children
  std::int64_t taps_ = 0;
  bool share_reads_;
};

}  // namespace chain_tracker::haar
