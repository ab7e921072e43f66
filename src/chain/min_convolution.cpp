// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/min_convolution.h"

#include <algorithm>
#include <limits>

#include "chain_tracker/image/multiversion.h"

namespace chain_tracker {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// Outputs held in registers while all offsets pass: wide enough for the longest vectors, and with
/// enough rows to hide the latency of the minimum.
constexpr int kBlockColumns = 8;
constexpr int kBlockRows = 4;

bool reachesNothing(const StencilOffset& offset, const cv::Size& map) {
  return std::abs(offset.columns) >= map.width || std::abs(offset.rows) >= map.height;
}

/// Where a block of a map begins, and how far apart its rows are.
template <typename Element>
struct Block {
  Element* first;
  std::ptrdiff_t stride;
};

/// out(y, x) = min over i of in(y, x - shifts[i]) + costs[i], plus added(y, x).
CHAIN_TRACKER_MULTIVERSION
void convolveBlock(const Block<const float>& in, const std::ptrdiff_t* shifts, const float* costs,
                   std::size_t offsets, const Block<const float>& added, const Block<float>& out) {
  const std::ptrdiff_t stride = in.stride;
  float least[kBlockRows][kBlockColumns];
  for (auto& row : least) std::fill(row, row + kBlockColumns, kInfinity);
  for (std::size_t i = 0; i < offsets; ++i) {
    const float* source = in.first - shifts[i];
    const float cost = costs[i];
    for (int y = 0; y < kBlockRows; ++y) {
      for (int x = 0; x < kBlockColumns; ++x) {
        const float candidate = source[y * stride + x] + cost;
        least[y][x] = candidate < least[y][x] ? candidate : least[y][x];
      }
    }
  }
  for (int y = 0; y < kBlockRows; ++y) {
    const float* __restrict own = added.first + y * added.stride;
    float* __restrict target = out.first + y * out.stride;
    for (int x = 0; x < kBlockColumns; ++x) target[x] = least[y][x] + own[x];
  }
}

}  // namespace

/// Makes the padded input all infinite, with room for `margin` around the input.
void MinConvolution::layOut(const cv::Size& margin) {
  margin_ = margin;
  // Blocks of maps smaller than a block read this far past the input.
  stride_ = size_.width + 2 * margin.width + kBlockColumns;
  const std::ptrdiff_t rows = size_.height + 2 * margin.height + kBlockRows;
  padded_.assign(static_cast<std::size_t>(stride_ * rows), kInfinity);
}

/// Lists the offsets that reach anything; returns how far they reach beyond the map.
cv::Size MinConvolution::listOffsets(const EdgeStencil& stencil) {
  shifts_.clear();
  costs_.clear();
  cv::Size margin;
  for (const StencilOffset& offset : stencil) {
    if (reachesNothing(offset, size_)) continue;
    margin.width = std::max(margin.width, std::abs(offset.columns));
    margin.height = std::max(margin.height, std::abs(offset.rows));
    shifts_.push_back(offset.rows * stride_ + offset.columns);
    costs_.push_back(offset.cost);
  }
  return margin;
}

/// Room around the maps serves again where it is enough.
void MinConvolution::setStencil(const EdgeStencil& stencil, const cv::Size& size) {
  if (size != size_) {
    size_ = size;
    layOut(margin_);
  }
  const cv::Size margin = listOffsets(stencil);
  if (margin.width <= margin_.width && margin.height <= margin_.height) return;
  layOut({std::max(margin.width, margin_.width), std::max(margin.height, margin_.height)});
  listOffsets(stencil);
}

/// Copies the input into the middle of the infinities; returns where it begins.
const float* MinConvolution::pad(const cv::Mat1f& in) {
  float* const first = padded_.data() + margin_.height * stride_ + margin_.width;
  for (int row = 0; row < in.rows; ++row) {
    std::copy(in[row], in[row] + in.cols, first + row * stride_);
  }
  return first;
}

/// `in`: of the padded input. The last blocks overlap those before them rather than reach beyond
/// the maps, which must be as large as a block.
void MinConvolution::runOnBlocks(const float* in, const cv::Mat1f& added, cv::Mat1f& out) const {
  const auto added_stride = static_cast<std::ptrdiff_t>(added.step1());
  const auto out_stride = static_cast<std::ptrdiff_t>(out.step1());
  for (int next_row = 0; next_row < out.rows; next_row += kBlockRows) {
    const int row = std::min(next_row, out.rows - kBlockRows);
    for (int next_column = 0; next_column < out.cols; next_column += kBlockColumns) {
      const int column = std::min(next_column, out.cols - kBlockColumns);
      convolveBlock({in + row * stride_ + column, stride_}, shifts_.data(), costs_.data(),
                    shifts_.size(), {added[row] + column, added_stride},
                    {out[row] + column, out_stride});
    }
  }
}

void MinConvolution::run(const cv::Mat1f& in, const cv::Mat1f& added, cv::Mat1f& out) {
  const float* first = pad(in);
  out.create(size_);
  if (size_.width >= kBlockColumns && size_.height >= kBlockRows) {
    runOnBlocks(first, added, out);
    return;
  }
  const cv::Rect map(cv::Point(), size_);
  const cv::Size enlarged(std::max(size_.width, kBlockColumns), std::max(size_.height, kBlockRows));
  enlarged_added_.create(enlarged);
  enlarged_added_.setTo(0.0F);
  added.copyTo(enlarged_added_(map));
  enlarged_out_.create(enlarged);
  runOnBlocks(first, enlarged_added_, enlarged_out_);
  enlarged_out_(map).copyTo(out);
}

}  // namespace chain_tracker
