// SPDX-License-Identifier: BSD-3-Clause
/// The message over an edge of the chain: out(q) = min over offsets o of in(q - o) + cost(o).
/// States outside `in` are forbidden. O(states x offsets of the stencil), so linear in the states.
#pragma once

#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/edge_stencil.h"

namespace chain_tracker {

struct MinConvolutionWorkspace {
  std::vector<float> padded;           ///< the input with a margin of infinities
  cv::Size size;                       ///< of the input
  cv::Size margin;                     ///< to each side of it
  std::ptrdiff_t stride = 0;           ///< of the rows of `padded`
  std::vector<std::ptrdiff_t> shifts;  ///< of the stencil's offsets in `padded`
  std::vector<float> costs;
};

/// `out` gets the size of `in`; +infinity where no state can be reached.
/// Offsets larger than the map are allowed and reach nothing.
void minConvolve(const cv::Mat1f& in, const EdgeStencil& stencil, cv::Mat1f& out,
                 MinConvolutionWorkspace& workspace);

/// The stencil of the same edge seen from its other end.
EdgeStencil reversed(EdgeStencil stencil);

}  // namespace chain_tracker
