// SPDX-License-Identifier: BSD-3-Clause
/// Ensembles of trees of kernels: how the responses of an ensemble grow out of the integral image
/// in passes (thesis ch. 5.2).
///
/// Node 0 is the integral image; every other node is a primitive kernel on it (sparse_kernel.h),
/// equal to an edge kernel times the kernel of its parent. All children of a node are computed in
/// one pass over it. The cost is counted in memory accesses per pixel:
///  - reads: in the pass over a node, a value that several edge kernels read, once they are shifted
///    against one another as read_delay says, is read once: the size of the union of the shifted
///    sets of taps;
///  - writes: a node writes once into a line buffer if it has children, and once into the response
///    of every feature that it is, up to shift, sign and scale.
/// The classic way reads every corner of every feature and writes every response.
#pragma once

#include <cstdint>
#include <vector>

#include "chain_tracker/haar/haar_feature.h"
#include "chain_tracker/haar/sparse_kernel.h"

namespace chain_tracker::haar {

struct PassNode {
  SparseKernel kernel;   ///< on the integral image; primitive
  int parent = -1;       ///< index of a node before this one; -1 for the integral image
  SparseKernel edge;     ///< primitive; kernel = edge * kernel of the parent
  cv::Point read_delay;  ///< shift of the edge against its siblings in their common pass
};

/// response(x, y) = scale * node(x - delay.x, y - delay.y)
struct FeatureNode {
  int node = 0;
  cv::Point delay;
  std::int64_t scale = 1;
};

struct PassTree {
  std::vector<PassNode> nodes;        ///< parents before children
  std::vector<FeatureNode> features;  ///< one for each feature of the ensemble, in its order
  bool reads_shared = true;           ///< whether siblings share reads
  std::int64_t least_accesses = 0;    ///< proven: no tree of the parser's space has fewer

  std::int64_t reads() const;
  std::int64_t writes() const;
  std::int64_t accesses() const { return reads() + writes(); }
  bool isProvenBest() const { return accesses() == least_accesses; }
};

/// Reads and writes of the classic way: corners plus one for each feature.
std::int64_t classicAccesses(const FeatureEnsemble& ensemble);

}  // namespace chain_tracker::haar
