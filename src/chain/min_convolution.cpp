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

struct Margin {
  int columns = 0;
  int rows = 0;
};

bool reachesNothing(const StencilOffset& offset, const cv::Mat1f& map) {
  return std::abs(offset.columns) >= map.cols || std::abs(offset.rows) >= map.rows;
}

Margin marginFor(const EdgeStencil& stencil, const cv::Mat1f& map) {
  Margin margin;
  for (const StencilOffset& offset : stencil) {
    if (reachesNothing(offset, map)) continue;
    margin.columns = std::max(margin.columns, std::abs(offset.columns));
    margin.rows = std::max(margin.rows, std::abs(offset.rows));
  }
  return margin;
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

}  // namespace

void minConvolve(const cv::Mat1f& in, const EdgeStencil& stencil, cv::Mat1f& out,
                 MinConvolutionWorkspace& workspace) {
  const Margin margin = marginFor(stencil, in);
  // Blocks at the right and lower edges of the output read this far past the input.
  const std::ptrdiff_t stride = in.cols + 2 * margin.columns + kBlockColumns;
  const std::ptrdiff_t rows = in.rows + 2 * margin.rows + kBlockRows;
  workspace.padded.assign(static_cast<std::size_t>(stride * rows), kInfinity);
  float* first = workspace.padded.data() + margin.rows * stride + margin.columns;
  for (int row = 0; row < in.rows; ++row) {
    std::copy(in[row], in[row] + in.cols, first + row * stride);
  }
  workspace.shifts.clear();
  workspace.costs.clear();
  for (const StencilOffset& offset : stencil) {
    if (reachesNothing(offset, in)) continue;
    workspace.shifts.push_back(offset.rows * stride + offset.columns);
    workspace.costs.push_back(offset.cost);
  }
  out.create(in.size());
  float block[kBlockRows * kBlockColumns];
  for (int row = 0; row < in.rows; row += kBlockRows) {
    for (int column = 0; column < in.cols; column += kBlockColumns) {
      convolveBlock(first + row * stride + column, stride, workspace.shifts.data(),
                    workspace.costs.data(), workspace.shifts.size(), block);
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
