// SPDX-License-Identifier: BSD-3-Clause
#include "spring_relaxation.h"

#include "chain_nodes.h"
#include "chain_tracker/image/pixel_geometry.h"
#include "rest_shape.h"

namespace chain_tracker {
namespace {

/// Of each edge from the one before in the first frame, as far as the shape is remembered.
std::vector<double> rememberedTurns(const std::vector<EdgeLayout>& edges, double shape_memory) {
  std::vector<double> turns(edges.size(), 0.0);
  for (size_t k = 1; k < edges.size(); ++k) {
    turns[k] = shape_memory * wrapAngle(edges[k].direction - edges[k - 1].direction);
  }
  return turns;
}

}  // namespace

SpringRelaxation::SpringRelaxation(const ChainModel& model,
                                   const std::vector<SegmentLayout>& layout) {
  for (size_t m = 0; m < layout.size(); ++m) {
    bend_sigmas_.push_back(model.segments[m].bend_sigma);
    remembered_turns_.push_back(rememberedTurns(layout[m].edges, model.segments[m].shape_memory));
  }
}

void SpringRelaxation::relax(const ChainState& state, double looseness,
                             std::vector<SegmentLayout>& layout) {
  for (size_t m = 0; m < layout.size(); ++m) {
    if (layout[m].layout != Layout::kDeformable) continue;
    const SegmentState& segment = state.segments[m];
    takeNodePositions(layout, state, m, nodes_);
    takeNodesHidden(layout[m], {state, segment}, nodes_hidden_);
    directions_.clear();
    edges_hidden_.clear();
    std::vector<EdgeLayout>& edges = layout[m].edges;
    for (size_t k = 0; k < edges.size(); ++k) {
      const double direction = directionOf(nodes_[k + 1] - nodes_[k]);
      directions_.push_back(wrapAngle(direction - segment.image_from_segment.angle));
      edges_hidden_.push_back(nodes_hidden_[k] || nodes_hidden_[k + 1]);
    }
    restDirections(directions_, edges_hidden_, remembered_turns_[m], rest_);
    for (size_t k = 0; k < edges.size(); ++k) {
      edges[k].direction = rest_[k];
      edges[k].bend_sigma = looseness * bend_sigmas_[m];
    }
  }
}

}  // namespace chain_tracker
