// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/window_histograms.h"

#include <cmath>

#include "chain_tracker/image/multiversion.h"
#include "reused_plane.h"

namespace chain_tracker {
namespace {

/// The whole window.
haar::FeatureEnsemble windowSum(int window_cells) {
  return {"window", {{"sum", {{0, 0, window_cells, window_cells, 1}}}}};
}

/// cells[entry](row, column) = number of pixels with that entry in the cell.
void countCells(const cv::Mat1b& entries, int step, std::vector<CellPlane>& cells) {
  const int columns = entries.cols / step;
  for (CellPlane& plane : cells) plane.setTo(0);
  std::vector<int*> rows(cells.size());
  for (int y = 0; y < entries.rows; ++y) {
    for (size_t b = 0; b < cells.size(); ++b) rows[b] = cells[b][y / step];
    const uchar* entry = entries[y];
    for (int column = 0; column < columns; ++column) {
      for (int i = 0; i < step; ++i) ++rows[*entry++][column];
    }
  }
}

/// Square roots of the sums' shares of the window.
CHAIN_TRACKER_MULTIVERSION
void takeRoots(const int* __restrict sum, float window_area, int columns, float* __restrict root) {
  const float scale = 1.0F / window_area;
  for (int x = 0; x < columns; ++x) root[x] = std::sqrt(static_cast<float>(sum[x]) * scale);
}

}  // namespace

WindowHistogramsWorkspace::WindowHistogramsWorkspace() : sums(windowSum) {}

void computeWindowHistograms(const cv::Mat& image, const ColorPalette& palette,
                             const WindowLattice& lattice, std::vector<cv::Mat1f>& roots,
                             WindowHistogramsWorkspace& workspace) {
  const cv::Size cells(lattice.size.width + lattice.window_cells - 1,
                       lattice.size.height + lattice.window_cells - 1);
  const auto entries = static_cast<size_t>(palette.size());
  palette.classify(image, lattice.pixels(), workspace.entries);
  workspace.cells.resize(entries);
  roots.resize(entries);
  for (CellPlane& plane : workspace.cells) reuse(plane, cells);
  countCells(workspace.entries, lattice.step, workspace.cells);
  const std::vector<cv::Mat1i>& sums =
      workspace.sums.compute(workspace.cells, lattice.window_cells, lattice.step * lattice.step);
  const auto side = static_cast<float>(lattice.window_cells * lattice.step);
  for (size_t b = 0; b < entries; ++b) {
    reuse(roots[b], lattice.size);
    for (int row = 0; row < lattice.size.height; ++row) {
      takeRoots(sums[b][row], side * side, lattice.size.width, roots[b][row]);
    }
  }
}

}  // namespace chain_tracker
