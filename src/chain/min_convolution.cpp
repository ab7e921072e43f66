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

/// block(y, x) = min over i of in[y stride + x - shifts[i]] + costs[i].
CHAIN_TRACKER_MULTIVERSION
void convolveBlock(const float* in, std::ptrdiff_t stride, const std::ptrdiff_t* shifts,
                   const float* costs, std::size_t offsets, float* block) {
  float least[kBlockRows][kBlockColumns];
  for (auto& row : least) std::fill(row, row + kBlockColumns, kInfinity);
  for (std::size_t i = 0; i < offsets; ++i) {
    const float* source = in - shifts[i];
    const float cost = costs[i];
    for (int y = 0; y < kBlockRows; ++y) {
      for (int x = 0; x < kBlockColumns; ++x) {
        const float candidate = source[y * stride + x] + cost;
        least[y][x] = candidate < least[y][x] ? candidate : least[y][x];
      }
    }
  }
  std::copy(&least[0][0], &least[0][0] + kBlockRows * kBlockColumns, block);
}

void copyBlock(const float* block, int row, int column, cv::Mat1f& out) {
  const int columns = std::min(kBlockColumns, out.cols - column);
  for (int y = 0; y < std::min(kBlockRows, out.rows - row); ++y) {
    const float* source = block + y * kBlockColumns;
    std::copy(source, source + columns, out[row + y] + column);
  }
}

/// Makes `padded` all infinite, with room for `margin` around the input.
void layOut(const cv::Size& size, const cv::Size& margin, MinConvolutionWorkspace& workspace) {
  workspace.size = size;
  workspace.margin = margin;
  // Blocks of maps smaller than a block read this far past the input.
  workspace.stride = size.width + 2 * margin.width + kBlockColumns;
  const std::ptrdiff_t rows = size.height + 2 * margin.height + kBlockRows;
  workspace.padded.assign(static_cast<std::size_t>(workspace.stride * rows), kInfinity);
}

/// Lists the offsets that reach anything; returns how far they reach beyond the map.
cv::Size listOffsets(const EdgeStencil& stencil, MinConvolutionWorkspace& workspace) {
  workspace.shifts.resize(stencil.size());
  workspace.costs.resize(stencil.size());
  std::size_t count = 0;
  cv::Size margin;
  for (const StencilOffset& offset : stencil) {
    if (reachesNothing(offset, workspace.size)) continue;
    margin.width = std::max(margin.width, std::abs(offset.columns));
    margin.height = std::max(margin.height, std::abs(offset.rows));
    workspace.shifts[count] = offset.rows * workspace.stride + offset.columns;
    workspace.costs[count] = offset.cost;
    ++count;
  }
  workspace.shifts.resize(count);
  workspace.costs.resize(count);
  return margin;
}

/// Makes room for the stencil around maps of a size. What is there serves again where it is enough.
void prepare(const EdgeStencil& stencil, const cv::Size& size, MinConvolutionWorkspace& workspace) {
  if (size != workspace.size) layOut(size, workspace.margin, workspace);
  const cv::Size margin = listOffsets(stencil, workspace);
  const cv::Size& kept = workspace.margin;
  if (margin.width <= kept.width && margin.height <= kept.height) return;
  layOut(size, {std::max(margin.width, kept.width), std::max(margin.height, kept.height)},
         workspace);
  listOffsets(stencil, workspace);
}

/// Copies the input into the middle of the infinities; returns where it begins.
const float* pad(const cv::Mat1f& in, MinConvolutionWorkspace& workspace) {
  float* const first =
      workspace.padded.data() + workspace.margin.height * workspace.stride + workspace.margin.width;
  for (int row = 0; row < in.rows; ++row) {
    std::copy(in[row], in[row] + in.cols, first + row * workspace.stride);
  }
  return first;
}

}  // namespace

void minConvolve(const cv::Mat1f& in, const EdgeStencil& stencil, cv::Mat1f& out,
                 MinConvolutionWorkspace& workspace) {
  const cv::Size size = in.size();
  prepare(stencil, size, workspace);
  const float* first = pad(in, workspace);
  out.create(size);
  float block[kBlockRows * kBlockColumns];
  // The last blocks overlap those before them rather than reach beyond the map.
  for (int next_row = 0; next_row < size.height; next_row += kBlockRows) {
    const int row = std::max(0, std::min(next_row, size.height - kBlockRows));
    for (int next_column = 0; next_column < size.width; next_column += kBlockColumns) {
      const int column = std::max(0, std::min(next_column, size.width - kBlockColumns));
      convolveBlock(first + row * workspace.stride + column, workspace.stride,
                    workspace.shifts.data(), workspace.costs.data(), workspace.shifts.size(),
                    block);
      copyBlock(block, row, column, out);
    }
  }
}

EdgeStencil reversed(EdgeStencil stencil) {
  for (StencilOffset& offset : stencil) {
    offset.columns = -offset.columns;
    offset.rows = -offset.rows;
  }
  return stencil;
}

}  // namespace chain_tracker
