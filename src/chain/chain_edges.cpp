// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/chain_edges.h"

#include <utility>

namespace chain_tracker {

ChainEdges::ChainEdges(const std::vector<EdgeStencil>& edges) {
  for (const EdgeStencil& edge : edges) addEdge(addKind(edge));
}

size_t ChainEdges::addKind(EdgeStencil stencil) {
  stencils_.push_back(std::move(stencil));
  return stencils_.size() - 1;
}

void ChainEdges::append(const ChainEdges& edges) {
  const size_t first = stencils_.size();
  stencils_.insert(stencils_.end(), edges.stencils_.begin(), edges.stencils_.end());
  for (size_t kind : edges.kinds_) addEdge(first + kind);
}

ChainEdges ChainEdges::reversed() const {
  ChainEdges backward;
  for (const EdgeStencil& stencil : stencils_) {
    backward.addKind(chain_tracker::reversed(stencil));
  }
  backward.kinds_.assign(kinds_.rbegin(), kinds_.rend());
  return backward;
}

}  // namespace chain_tracker
