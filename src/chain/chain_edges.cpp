// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/chain_edges.h"

namespace chain_tracker {

ChainEdges::ChainEdges(const std::vector<EdgeStencil>& edges) {
  for (const EdgeStencil& edge : edges) {
    addEdge(kinds());
    addKind() = edge;
  }
}

void ChainEdges::clear() {
  kinds_ = 0;
  kind_of_edge_.clear();
}

EdgeStencil& ChainEdges::addKind() {
  if (kinds_ == stencils_.size()) stencils_.emplace_back();
  EdgeStencil& stencil = stencils_[kinds_++];
  stencil.clear();
  return stencil;
}

void ChainEdges::append(const ChainEdges& edges) {
  const size_t first = kinds_;
  for (size_t kind = 0; kind < edges.kinds_; ++kind) addKind() = edges.stencils_[kind];
  for (size_t kind : edges.kind_of_edge_) addEdge(first + kind);
}

void ChainEdges::assignReversed(const ChainEdges& edges) {
  clear();
  for (size_t kind = 0; kind < edges.kinds_; ++kind) {
    EdgeStencil& stencil = addKind();
    stencil = edges.stencils_[kind];
    reverse(stencil);
  }
  kind_of_edge_.assign(edges.kind_of_edge_.rbegin(), edges.kind_of_edge_.rend());
}

}  // namespace chain_tracker
