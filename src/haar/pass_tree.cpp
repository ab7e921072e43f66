// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/haar/pass_tree.h"

#include <set>
#include <utility>

#include "chain_tracker/haar/double_difference.h"

namespace chain_tracker::haar {
namespace {

std::int64_t readsOfPass(const PassTree& tree, int parent) {
  std::set<std::pair<int, int>> places;
  std::int64_t taps = 0;
  for (const PassNode& node : tree.nodes) {
    if (node.parent != parent) continue;
    taps += static_cast<std::int64_t>(node.edge.size());
    for (const KernelTap& tap : node.edge.taps()) {
      places.emplace(tap.dx + node.read_delay.x, tap.dy + node.read_delay.y);
    }
  }
  return tree.reads_shared ? static_cast<std::int64_t>(places.size()) : taps;
}

}  // namespace

std::int64_t PassTree::reads() const {
  std::set<int> parents;
  for (const PassNode& node : nodes) {
    if (node.parent >= 0) parents.insert(node.parent);
  }
  std::int64_t reads = 0;
  for (const int parent : parents) reads += readsOfPass(*this, parent);
  return reads;
}

std::int64_t PassTree::writes() const {
  std::set<int> buffers;
  for (const PassNode& node : nodes) {
    if (node.parent > 0) buffers.insert(node.parent);
  }
  return static_cast<std::int64_t>(buffers.size() + features.size());
}

std::int64_t classicAccesses(const FeatureEnsemble& ensemble) {
  size_t accesses = 0;
  for (const HaarFeature& feature : ensemble.features()) {
    accesses += doubleDifference(feature).size() + 1;
  }
  return static_cast<std::int64_t>(accesses);
}

}  // namespace chain_tracker::haar
