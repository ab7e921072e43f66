// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/chain_solver.h"

#include <algorithm>
#include <limits>

namespace chain_tracker {
namespace {

/// The state of part k from which its best successor in `state` is reached.
cv::Point bestPredecessor(const cv::Mat1f& forward, const EdgeStencil& edge,
                          const cv::Point& state) {
  const cv::Rect map(cv::Point(), forward.size());
  cv::Point best(-1, -1);
  float best_cost = std::numeric_limits<float>::infinity();
  for (const StencilOffset& offset : edge) {
    const cv::Point previous(state.x - offset.columns, state.y - offset.rows);
    if (!map.contains(previous)) continue;
    const float cost = forward(previous) + offset.cost;
    if (cost < best_cost) {
      best_cost = cost;
      best = previous;
    }
  }
  return best;
}

}  // namespace

cv::Point cheapestState(const cv::Mat1f& map) {
  cv::Point cheapest;
  float least = std::numeric_limits<float>::infinity();
  for (int row = 0; row < map.rows; ++row) {
    const float* costs = map[row];
    const float* smallest = std::min_element(costs, costs + map.cols);
    if (*smallest >= least) continue;
    least = *smallest;
    cheapest = {static_cast<int>(smallest - costs), row};
  }
  return cheapest;
}

double forwardPass(const std::vector<cv::Mat1f>& unary, const ChainEdges& edges,
                   ChainSolverWorkspace& workspace) {
  workspace.forward.resize(unary.size());
  unary.front().copyTo(workspace.forward.front());
  for (size_t k = 1; k < unary.size(); ++k) {
    if (k == 1 || !edges.areEqual(k - 1, k - 2)) {
      workspace.convolution.setStencil(edges[k - 1], unary[k].size());
    }
    workspace.convolution.run(workspace.forward[k - 1], unary[k], workspace.forward[k]);
  }
  const cv::Mat1f& last = workspace.forward.back();
  return last(cheapestState(last));
}

void traceBack(const ChainEdges& edges, const cv::Point& end, const ChainSolverWorkspace& workspace,
               std::vector<cv::Point>& states) {
  states.resize(workspace.forward.size());
  states.back() = end;
  for (size_t k = edges.size(); k > 0; --k) {
    states[k - 1] = bestPredecessor(workspace.forward[k - 1], edges[k - 1], states[k]);
  }
}

void minMarginals(const std::vector<cv::Mat1f>& unary, const ChainEdges& edges,
                  std::vector<cv::Mat1f>& marginals, ChainSolverWorkspace& workspace) {
  const size_t parts = unary.size();
  marginals.resize(parts);
  workspace.backward_edges.assignReversed(edges);
  workspace.backward.resize(parts);
  if (workspace.zeros.size() != unary.front().size()) {
    workspace.zeros = cv::Mat1f::zeros(unary.front().size());
  }
  workspace.forward.back().copyTo(marginals.back());
  unary.back().copyTo(workspace.sum);
  for (size_t k = parts - 1; k > 0; --k) {
    cv::Mat1f& message = workspace.backward[k - 1];
    workspace.convolution.setStencil(workspace.backward_edges[parts - 1 - k], unary[k].size());
    workspace.convolution.run(workspace.sum, workspace.zeros, message);
    cv::add(workspace.forward[k - 1], message, marginals[k - 1]);
    cv::add(unary[k - 1], message, workspace.sum);
  }
}

}  // namespace chain_tracker
