// SPDX-License-Identifier: BSD-3-Clause
#include "kernel_forest.h"

#include <algorithm>

namespace chain_tracker::haar {
namespace {

size_t indexOf(int kernel) { return static_cast<size_t>(kernel); }

}  // namespace

KernelForest::KernelForest(const KernelLattice& lattice, const std::vector<int>& features,
                           bool share_reads)
    : lattice_(&lattice),
      parents_(indexOf(lattice.size()), kAbsent),
      shifts_(indexOf(lattice.size())),
      child_counts_(indexOf(lattice.size()), 0),
      features_(indexOf(lattice.size()), 0),
      share_reads_(share_reads) {
  for (size_t i = 0; i < features.size(); ++i) {
    features_[indexOf(lattice.targets()[i])] = features[i];
  }
}

std::vector<int> KernelForest::children(int kernel) const {
  std::vector<int> children;
  for (const int node : nodes_) {
    if (parent(node) == kernel) children.push_back(node);
  }
  return children;
}

int KernelForest::ringRows(int kernel) const {
  int rows = 0;
  for (const int child : children(kernel)) {
    rows = std::max(rows, lattice_->edge(child, kernel)->ring_rows);
  }
  return rows;
}

int KernelForest::readsOf(int kernel) const {
  const auto reads = reads_.find(kernel);
  return reads == reads_.end() ? 0 : reads->second.size();
}

ForestCost KernelForest::cost() const {
  ForestCost cost{share_reads_ ? readsOf(0) : taps_, taps_, ringRows(0)};
  for (const int node : nodes_) {
    cost.accesses += features_[indexOf(node)];
    if (child_counts_[indexOf(node)] == 0) continue;
    cost.accesses += 1 + (share_reads_ ? readsOf(node) : 0);
    cost.ring_rows += ringRows(node);
  }
  return cost;
}

KernelForest::Placement KernelForest::placement(int kernel, int parent,
                                                std::uint32_t tie_breaker) const {
  const KernelLattice::Edge* edge = lattice_->edge(kernel, parent);
  if (edge == nullptr) return {};
  const auto taps = static_cast<int>(edge->support.size());
  ReadSet::Placement place{{}, taps};
  const auto reads = reads_.find(parent);
  if (share_reads_ && reads != reads_.end()) {
    place = reads->second.bestPlacement(edge->support, tie_breaker);
  }
  const bool is_first = parent != 0 && child_counts_[indexOf(parent)] == 0;
  const int more_rows = std::max(0, edge->ring_rows - ringRows(parent));
  return {true, place.shift, {place.new_reads + (is_first ? 1 : 0), taps, more_rows}};
}

void KernelForest::attach(int kernel, int parent, const cv::Point& shift) {
  const Support& support = lattice_->edge(kernel, parent)->support;
  nodes_.push_back(kernel);
  parents_[indexOf(kernel)] = parent;
  shifts_[indexOf(kernel)] = shift;
  ++child_counts_[indexOf(parent)];
  reads_[parent].add(support, shift);
  taps_ += static_cast<std::int64_t>(support.size());
}

void KernelForest::detach(int kernel) {
  const int above = parent(kernel);
  const Support& support = lattice_->edge(kernel, above)->support;
  reads_[above].remove(support, shifts_[indexOf(kernel)]);
  taps_ -= static_cast<std::int64_t>(support.size());
  parents_[indexOf(kernel)] = kAbsent;
  nodes_.erase(std::find(nodes_.begin(), nodes_.end(), kernel));
  if (--child_counts_[indexOf(above)] == 0) reads_.erase(above);
}

void KernelForest::detachWithDeadEnds(int kernel) {
  while (kernel != 0) {
    const int above = parent(kernel);
    detach(kernel);
    if (child_counts_[indexOf(above)] > 0 || features_[indexOf(above)] > 0) return;
    kernel = above;
  }
}

void KernelForest::realign() {
  std::vector<int> parents = nodes_;
  parents.push_back(0);
  for (const int node : parents) {
    const std::vector<int> siblings = children(node);
    if (siblings.size() < 2) continue;
    std::vector<Support> supports;
    supports.reserve(siblings.size());
    for (const int child : siblings) supports.push_back(lattice_->edge(child, node)->support);
    const ReadAlignment alignment = alignReads(supports);
    if (alignment.reads >= readsOf(node)) continue;
    for (const int child : siblings) detach(child);
    for (size_t i = 0; i < siblings.size(); ++i) attach(siblings[i], node, alignment.shifts[i]);
  }
}

PassTree KernelForest::tree(const std::vector<FeatureNode>& features) const {
  PassTree tree;
  tree.reads_shared = share_reads_;
  tree.nodes.push_back({SparseKernel::one(), -1, {}, {}});
  std::vector<int> place(parents_.size(), 0);
  std::vector<int> order = nodes_;
  // A kernel has larger delays than its divisors: parents come first.
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    const cv::Point delay_a = lattice_->kernel(a).maxDelay();
    const cv::Point delay_b = lattice_->kernel(b).maxDelay();
    return delay_a.x + delay_a.y < delay_b.x + delay_b.y;
  });
  for (const int node : order) {
    place[indexOf(node)] = static_cast<int>(tree.nodes.size());
    tree.nodes.push_back({lattice_->kernel(node), place[indexOf(parent(node))],
                          lattice_->edge(node, parent(node))->kernel, shifts_[indexOf(node)]});
  }
  for (FeatureNode feature : features) {
    feature.node = place[indexOf(feature.node)];
    tree.features.push_back(feature);
  }
  return tree;
}

}  // namespace chain_tracker::haar
