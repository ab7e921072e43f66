// SPDX-License-Identifier: BSD-3-Clause
/// The stencils along a chain, of which equal ones are kept once: the edges of a grid of parts have
/// few kinds. Filled anew, it allocates only where it never had as many stencils or as large ones.
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

  size_t size() const { return kind_of_edge_.size(); }
  const EdgeStencil& operator[](size_t edge) const { return stencils_[kind_of_edge_[edge]]; }
  bool areEqual(size_t a, size_t b) const { return kind_of_edge_[a] == kind_of_edge_[b]; }

  /// Leaves no edges and no kinds.
  void clear();
  /// Kinds are counted from 0 in the order in which they are added.
  size_t kinds() const { return kinds_; }
  /// The empty stencil of a new kind, of which there are no edges yet; valid until the next one.
  EdgeStencil& addKind();
  void addEdge(size_t kind) { kind_of_edge_.push_back(kind); }
  void append(const ChainEdges& edges);
  /// Becomes the other chain from its other end.
  void assignReversed(const ChainEdges& edges);

 private:
  size_t kinds_ = 0;
  std::vector<EdgeStencil> stencils_;  ///< of the kinds; the memory of others behind them is kept
  std::vector<size_t> kind_of_edge_;
};

}  // namespace chain_tracker
