// SPDX-License-Identifier: BSD-3-Clause
/// The message over an edge of the chain: out(q) = min over offsets o of in(q - o) + cost(o), plus
/// what the receiving part has to say.
/// States outside `in` are forbidden. O(states x offsets of the stencil), so linear in the states.
#pragma once

#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/edge_stencil.h"

namespace chain_tracker {

class MinConvolution {
 public:
  /// What the next maps are convolved with, and their size. Offsets larger than the map are allowed
  /// and reach nothing. O(offsets).
  void setStencil(const EdgeStencil& stencil, const cv::Size& size);

  /// `in` and `added` must have the size set, and `out` gets it; +infinity where no state can be
  /// reached. `out` may be `in`, but not `added`.
  void run(const cv::Mat1f& in, const cv::Mat1f& added, cv::Mat1f& out);

 private:
  void layOut(const cv::Size& margin);
  cv::Size listOffsets(const EdgeStencil& stencil);
  const float* pad(const cv::Mat1f& in);
  void runOnBlocks(const float* in, const cv::Mat1f& added, cv::Mat1f& out) const;

  cv::Size size_;
  cv::Size margin_;                     ///< to each side of the input
  std::ptrdiff_t stride_ = 0;           ///< of the rows of the padded input
  std::vector<float> padded_;           ///< the input with a margin of infinities
  std::vector<std::ptrdiff_t> shifts_;  ///< of the stencil's offsets in the padded input
  std::vector<float> costs_;
  cv::Mat1f enlarged_added_;  ///< for maps smaller than a block
  cv::Mat1f enlarged_out_;
};

}  // namespace chain_tracker
