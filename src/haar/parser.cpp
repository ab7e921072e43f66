// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/haar/parser.h"

#include <map>
#include <stdexcept>

#include "chain_tracker/haar/double_difference.h"
#include "exact_search.h"
#include "forest_search.h"
#include "kernel_forest.h"
#include "kernel_lattice.h"

namespace chain_tracker::haar {
namespace {

/// Kernels that differ by more than shift, sign and scale.
struct Targets {
  std::vector<SparseKernel> kernels;
  std::vector<int> counts;            ///< features that each is
  std::vector<cv::Point> positions;   ///< delay of the first of them
  std::vector<FeatureNode> features;  ///< nodes are indices into kernels
};

Targets targetsOf(const FeatureEnsemble& ensemble) {
  Targets targets;
  std::map<SparseKernel, int> known;
  for (const AlignedKernel& kernel : alignedKernels(ensemble)) {
    const auto [entry, is_new] =
        known.try_emplace(kernel.primitive, static_cast<int>(known.size()));
    if (is_new) {
      targets.kernels.push_back(kernel.primitive);
      targets.counts.push_back(0);
      targets.positions.push_back(kernel.delay);
    }
    ++targets.counts[static_cast<size_t>(entry->second)];
    targets.features.push_back({entry->second, kernel.delay, kernel.scale});
  }
  return targets;
}

}  // namespace

std::vector<AlignedKernel> alignedKernels(const FeatureEnsemble& ensemble) {
  std::vector<AlignedKernel> kernels;
  for (const HaarFeature& feature : ensemble.features()) {
    const SparseKernel kernel = doubleDifference(feature);
    if (kernel.isZero()) {
      throw std::invalid_argument("ensemble '" + ensemble.name() + "': feature '" + feature.name +
                                  "': its rectangles cancel, the response is always 0");
    }
    kernels.push_back(alignedKernel(kernel));
  }
  return kernels;
}

PassTree parse(const FeatureEnsemble& ensemble, const ParserOptions& options) {
  const Targets targets = targetsOf(ensemble);
  const bool is_searched = targets.kernels.size() <= kMaxSearched;
  const KernelLattice lattice(targets.kernels, options.factor && is_searched);
  std::vector<FeatureNode> features;
  for (size_t i = 0; i < targets.features.size(); ++i) {
    features.push_back(targets.features[i]);
    features.back().node = lattice.targets()[static_cast<size_t>(features.back().node)];
  }
  KernelForest forest =
      directForest(lattice, targets.counts, targets.positions, options.share_reads);
  if (is_searched) forest = searchForest(lattice, forest, options.search_rounds);
  std::int64_t least = trivialBound(static_cast<std::int64_t>(ensemble.size()));
  if (is_searched && lattice.size() <= kMaxExact && options.exact_work > 0) {
    ExactResult exact =
        searchExactly(lattice, targets.counts, forest.cost().accesses, options.exact_work);
    least = exact.least;
    if (exact.best && options.share_reads) forest = *exact.best;
  }
  PassTree tree = forest.tree(features);
  tree.least_accesses = least;
  return tree;
}

PassTree parseSeparately(const FeatureEnsemble& ensemble, const ParserOptions& options) {
  PassTree tree;
  tree.reads_shared = false;
  tree.nodes.push_back({SparseKernel::one(), -1, {}, {}});
  for (const HaarFeature& feature : ensemble.features()) {
    const PassTree alone = parse({ensemble.name(), {feature}}, options);
    const int offset = static_cast<int>(tree.nodes.size()) - 1;
    for (size_t i = 1; i < alone.nodes.size(); ++i) {
      tree.nodes.push_back(alone.nodes[i]);
      if (alone.nodes[i].parent > 0) tree.nodes.back().parent += offset;
    }
    tree.features.push_back(alone.features.front());
    tree.features.back().node += offset;
  }
  return tree;
}

}  // namespace chain_tracker::haar
