// SPDX-License-Identifier: BSD-3-Clause
/// The stencils along a chain, of which equal ones are kept once: the edges of a grid of parts have
/// few kinds.
#pragma once

#include <cstddef>
#include <vector>

#include "chain_tracker/chain/edge_stencil.h"

namespace chain_tracker {

class ChainEdges {
 public:
  ChainEdges() = default;
  /// Every edge is of a kind of its own.
  ChainEdges(const std::vector<EdgeStencil>& edges);  // NOLINT(google-explicit-constructor)

  size_t size() const { return kinds_.size(); }
  const EdgeStencil& operator[](size_t edge) const { return stencils_[kinds_[edge]]; }
  bool areEqual(size_t a, size_t b) const { return kinds_[a] == kinds_[b]; }

  /// Returns the new kind, of which there are no edges yet.
  size_t addKind(EdgeStencil stencil);
  void addEdge(size_t kind) { kinds_.push_back(kind); }
  void append(const ChainEdges& edges);
  /// The same chain from its other end.
  ChainEdges reversed() const;

 private:
  std::vector<EdgeStencil> stencils_;
  std::vector<size_t> kinds_;  ///< of the edges
};

}  // namespace chain_tracker
