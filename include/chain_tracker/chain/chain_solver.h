// SPDX-License-Identifier: BSD-3-Clause
/// Exact matching of a chain by dynamic programming (thesis ch. 3.4.2; Felzenszwalb and
/// Huttenlocher 2005). Minimises over the states q_1 .. q_K
///   E(q) = sum_k unary_k(q_k) + sum_k edge_k(q_{k+1} - q_k).
/// The solution is globally optimal on the given lattice under the cut-off springs.
/// O(K x states x offsets of a stencil). Ties go to the smallest row-major state of the last part,
/// then to the first offset of each stencil.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_edges.h"
#include "chain_tracker/chain/min_convolution.h"

namespace chain_tracker {

/// Kept from call to call so that no memory is allocated once sizes have settled.
struct ChainSolverWorkspace {
  std::vector<cv::Mat1f> forward;   ///< unary_k plus the message from part k - 1
  std::vector<cv::Mat1f> backward;  ///< the message from part k + 1
  ChainEdges backward_edges;
  cv::Mat1f sum;
  cv::Mat1f zeros;
  MinConvolution convolution;
};

/// Cost of the best chain; +infinity if the springs allow none. Fills workspace.forward.
/// `unary`: one map a part, all of one size; `edges`: one fewer.
double forwardPass(const std::vector<cv::Mat1f>& unary, const ChainEdges& edges,
                   ChainSolverWorkspace& workspace);

/// The state of least cost; the first one in row-major order among equals.
cv::Point cheapestState(const cv::Mat1f& map);

/// `states` become those (x column, y row) of the best chain whose last part is in state `end`,
/// from workspace.forward as forwardPass() left it. The cost of that state must be finite.
void traceBack(const ChainEdges& edges, const cv::Point& end, const ChainSolverWorkspace& workspace,
               std::vector<cv::Point>& states);

/// marginals[k](q): the cost of the best chain that has part k in state q. Needs
/// workspace.forward.
void minMarginals(const std::vector<cv::Mat1f>& unary, const ChainEdges& edges,
                  std::vector<cv::Mat1f>& marginals, ChainSolverWorkspace& workspace);

}  // namespace chain_tracker
