// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/window_histograms.h"

#include <algorithm>
#include <cmath>

namespace chain_tracker {
namespace {

/// cells[entry](row, column) = number of pixels with that entry in the cell.
void countCells(const cv::Mat1b& entries, int step, std::vector<cv::Mat1f>& cells) {
  const int columns = entries.cols / step;
  for (cv::Mat1f& plane : cells) plane.setTo(0.0F);
  std::vector<float*> rows(cells.size());
  for (int y = 0; y < entries.rows; ++y) {
    for (size_t b = 0; b < cells.size(); ++b) rows[b] = cells[b][y / step];
    const uchar* entry = entries[y];
    for (int column = 0; column < columns; ++column) {
      for (int i = 0; i < step; ++i) rows[*entry++][column] += 1.0F;
    }
  }
}

/// Sums over `cells` rows and columns at every position; counts are whole numbers below 2^24, so
/// the running sums are exact.
void sumWindows(const cv::Mat1f& plane, int cells, cv::Mat1f& column_sums, cv::Mat1f& sums) {
  column_sums.create(1, plane.cols);
  column_sums.setTo(0.0F);
  float* __restrict column_sum = column_sums[0];
  const int columns = plane.cols;
  for (int row = 0; row < plane.rows; ++row) {
    const float* __restrict entering = plane[row];
    for (int x = 0; x < columns; ++x) column_sum[x] += entering[x];
    if (row >= cells) {
      const float* __restrict leaving = plane[row - cells];
      for (int x = 0; x < columns; ++x) column_sum[x] -= leaving[x];
    }
    if (row < cells - 1) continue;
    float* out = sums[row - cells + 1];
    float sum = 0.0F;
    for (int x = 0; x < cells - 1; ++x) sum += column_sum[x];
    for (int x = 0; x < sums.cols; ++x) {
      sum += column_sum[x + cells - 1];
      out[x] = sum;
      sum -= column_sum[x];
    }
  }
}

void takeRoots(cv::Mat1f& sums, float window_area) {
  for (int row = 0; row < sums.rows; ++row) {
    float* __restrict value = sums[row];
    const int columns = sums.cols;
    const float scale = 1.0F / window_area;
    for (int x = 0; x < columns; ++x) value[x] = std::sqrt(value[x] * scale);
  }
}

}  // namespace

void computeWindowHistograms(const cv::Mat& image, const ColorPalette& palette,
                             const WindowLattice& lattice, std::vector<cv::Mat1f>& roots,
                             WindowHistogramsWorkspace& workspace) {
  const cv::Size cells(lattice.size.width + lattice.window_cells - 1,
                       lattice.size.height + lattice.window_cells - 1);
  const auto entries = static_cast<size_t>(palette.size());
  palette.classify(image, lattice.pixels(), workspace.entries);
  workspace.cells.resize(entries);
  roots.resize(entries);
  for (cv::Mat1f& plane : workspace.cells) plane.create(cells);
  countCells(workspace.entries, lattice.step, workspace.cells);
  const auto side = static_cast<float>(lattice.window_cells * lattice.step);
  for (size_t b = 0; b < entries; ++b) {
    roots[b].create(lattice.size);
    sumWindows(workspace.cells[b], lattice.window_cells, workspace.column_sums, roots[b]);
    takeRoots(roots[b], side * side);
  }
}

}  // namespace chain_tracker
