// SPDX-License-Identifier: BSD-3-Clause
#include "narrowing.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "kernel_lattice.h"
#include "read_alignment.h"

namespace chain_tracker::haar {
namespace {

constexpr int kNarrowBytes = 2;
constexpr int kWideBytes = 4;

/// From the integral image through kernels of a lattice, in this order, to the lattice's target.
struct Chain {
  std::vector<int> kernels;
  int bytes = std::numeric_limits<int>::max();
};

/// The children of every node.
std::vector<int> childCounts(const PassTree& tree) {
  std::vector<int> counts(tree.nodes.size(), 0);
  for (const PassNode& node : tree.nodes) {
    if (node.parent >= 0) ++counts[static_cast<size_t>(node.parent)];
  }
  return counts;
}

std::optional<int> nodeOf(const PassTree& tree, const SparseKernel& kernel) {
  const auto node = std::find_if(tree.nodes.begin(), tree.nodes.end(),
                                 [&](const PassNode& other) { return other.kernel == kernel; });
  if (node == tree.nodes.end()) return std::nullopt;
  return static_cast<int>(node - tree.nodes.begin());
}

/// Bytes moved per pixel by the pass into a leaf, and by that into its parent if that is needed
/// for the leaf alone.
int bytesOfWideLeaf(const PassTree& tree, const std::vector<int>& children, const PassNode& leaf) {
  const auto parent = static_cast<size_t>(leaf.parent);
  int accesses = static_cast<int>(leaf.edge.size());
  if (parent != 0 && children[parent] == 1) {
    accesses += static_cast<int>(tree.nodes[parent].edge.size()) + 1;
  }
  return kWideBytes * accesses;
}

/// The chain of narrow passes to the target that moves the fewest bytes per pixel.
class NarrowChainSearch {
 public:
  NarrowChainSearch(const PassTree& tree, const SparseKernel& target, int max_pixel)
      : tree_(tree), lattice_({target}, true), target_(lattice_.targets().front()) {
    for (const int divisor : lattice_.divisors(0)) {
      const auto range = rangeOnImage(lattice_.kernel(divisor), max_pixel);
      if (!range || !fits16(*range) || lattice_.edge(target_, divisor) == nullptr) continue;
      consider({divisor});
      for (const int first : lattice_.divisors(0)) {
        if (lattice_.edge(divisor, first) != nullptr) consider({first, divisor});
      }
    }
  }

  const Chain& best() const { return best_; }
  const KernelLattice& lattice() const { return lattice_; }

 private:
  void consider(const std::vector<int>& kernels) {
    int accesses = static_cast<int>(lattice_.edge(target_, kernels.back())->support.size());
    int parent = 0;
    for (const int kernel : kernels) {
      const bool is_there = nodeOf(tree_, lattice_.kernel(kernel)).has_value();
      if (!is_there) {
        accesses += static_cast<int>(lattice_.edge(kernel, parent)->support.size()) + 1;
      }
      parent = kernel;
    }
    if (kNarrowBytes * accesses < best_.bytes) best_ = {kernels, kNarrowBytes * accesses};
  }

  const PassTree& tree_;
  KernelLattice lattice_;
  int target_;
  Chain best_;
};

/// Adds the kernels of the chain that the tree does not have; returns the last one's node.
int addChain(PassTree& tree, const KernelLattice& lattice, const Chain& chain) {
  int parent = 0;
  int parent_kernel = 0;
  for (const int kernel : chain.kernels) {
    const std::optional<int> known = nodeOf(tree, lattice.kernel(kernel));
    if (!known) {
      tree.nodes.push_back(
          {lattice.kernel(kernel), parent, lattice.edge(kernel, parent_kernel)->kernel, {}});
    }
    parent = known.value_or(static_cast<int>(tree.nodes.size()) - 1);
    parent_kernel = kernel;
  }
  return parent;
}

/// Parents first, without nodes that no feature needs.
PassTree inOrder(const PassTree& tree) {
  std::vector<int> places(tree.nodes.size(), -1);
  PassTree ordered = tree;
  ordered.nodes.clear();
  const auto place = [&](const auto& self, int node) -> int {
    int& at = places[static_cast<size_t>(node)];
    if (at >= 0) return at;
    PassNode copy = tree.nodes[static_cast<size_t>(node)];
    if (copy.parent >= 0) copy.parent = self(self, copy.parent);
    ordered.nodes.push_back(std::move(copy));
    return at = static_cast<int>(ordered.nodes.size()) - 1;
  };
  place(place, 0);
  for (FeatureNode& feature : ordered.features) feature.node = place(place, feature.node);
  return ordered;
}

/// Shifts the children of every node against one another so that they read the fewest values.
void alignSiblings(PassTree& tree) {
  std::vector<std::vector<size_t>> children(tree.nodes.size());
  for (size_t i = 1; i < tree.nodes.size(); ++i) {
    children[static_cast<size_t>(tree.nodes[i].parent)].push_back(i);
  }
  for (const std::vector<size_t>& siblings : children) {
    if (siblings.empty()) continue;
    std::vector<Support> supports;
    supports.reserve(siblings.size());
    for (const size_t node : siblings) supports.push_back(supportOf(tree.nodes[node].edge));
    const ReadAlignment alignment = alignReads(supports);
    for (size_t i = 0; i < siblings.size(); ++i) {
      tree.nodes[siblings[i]].read_delay = alignment.shifts[i];
    }
  }
}

}  // namespace

bool fits16(const ValueRange& range) {
  return range.within(std::numeric_limits<std::int16_t>::min(),
                      std::numeric_limits<std::int16_t>::max()) ||
         range.within(0, std::numeric_limits<std::uint16_t>::max());
}

PassTree narrowedTree(const PassTree& tree, const std::vector<ValueRange>& ranges, int max_pixel) {
  PassTree narrowed = tree;
  const std::vector<int> children = childCounts(tree);
  for (size_t i = 0; i < ranges.size(); ++i) {
    const auto leaf = static_cast<size_t>(tree.features[i].node);
    if (fits16(ranges[i]) || children[leaf] > 0) continue;
    const NarrowChainSearch search(narrowed, tree.nodes[leaf].kernel, max_pixel);
    if (search.best().bytes > bytesOfWideLeaf(tree, children, tree.nodes[leaf])) continue;
    const int parent = addChain(narrowed, search.lattice(), search.best());
    PassNode& node = narrowed.nodes[leaf];
    node.parent = parent;
    node.edge = *node.kernel.dividedBy(narrowed.nodes[static_cast<size_t>(parent)].kernel);
  }
  narrowed = inOrder(narrowed);
  alignSiblings(narrowed);
  return narrowed;
}

}  // namespace chain_tracker::haar
