// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/haar/parser.h"

#include <map>
#include <stdexcept>

#include "chain_tracker/haar/double_difference.h"

namespace chain_tracker::haar {

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

PassTree parse(const FeatureEnsemble& ensemble, const ParserOptions&) {
  PassTree tree;
  tree.nodes.push_back({SparseKernel::one(), -1, {}, {}});
  std::map<SparseKernel, int> nodes;
  for (const AlignedKernel& kernel : alignedKernels(ensemble)) {
    const auto [entry, is_new] =
        nodes.try_emplace(kernel.primitive, static_cast<int>(tree.nodes.size()));
    if (is_new) tree.nodes.push_back({kernel.primitive, 0, kernel.primitive, {}});
    tree.features.push_back({entry->second, kernel.delay, kernel.scale});
  }
  return tree;
}

PassTree parseSeparately(const FeatureEnsemble& ensemble, const ParserOptions& options) {
  return parse(ensemble, options);
}

}  // namespace chain_tracker::haar
