// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/window_histograms.h"

#include <algorithm>
#include <cmath>

#include "chain_tracker/image/multiversion.h"
#include "reused_plane.h"

namespace chain_tracker {
namespace {

/// The whole window.
haar::FeatureEnsemble windowSum(int window_cells) {
  return {"window", {{"sum", {{0, 0, window_cells, window_cells, 1}}}}};
}

/// planes[entry](row, column) += number of pixels with that entry in the cell.
void countCells(const cv::Mat1b& entries, int step, const std::vector<CellPlane*>& planes) {
  const int columns = entries.cols / step;
  std::vector<int*> rows(planes.size());
  for (int y = 0; y < entries.rows; ++y) {
    for (size_t b = 0; b < planes.size(); ++b) rows[b] = (*planes[b])[y / step];
    const uchar* entry = entries[y];
    for (int column = 0; column < columns; ++column) {
      for (int i = 0; i < step; ++i) ++rows[*entry++][column];
    }
  }
}

/// Empty cells: for each entry its plane, which for all unwanted ones is the same.
std::vector<CellPlane*> clearedPlanes(const std::vector<bool>& wanted, const cv::Size& cells,
                                      WindowHistogramsWorkspace& workspace) {
  const auto count = static_cast<size_t>(std::count(wanted.begin(), wanted.end(), true));
  std::vector<CellPlane>& planes = workspace.planes;
  planes.resize(std::max(planes.size(), count + 1));
  for (size_t i = 0; i <= count; ++i) {
    reuse(planes[i], cells);
    planes[i].setTo(0);
  }
  workspace.cells.assign(planes.begin(), planes.begin() + static_cast<std::ptrdiff_t>(count));
  std::vector<CellPlane*> of_entries;
  of_entries.reserve(wanted.size());
  auto next = planes.begin();
  for (const bool is_wanted : wanted) of_entries.push_back(is_wanted ? &*next++ : &planes[count]);
  return of_entries;
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
                             const WindowLattice& lattice, const std::vector<bool>& wanted,
                             std::vector<cv::Mat1f>& roots, WindowHistogramsWorkspace& workspace) {
  const cv::Size cells(lattice.size.width + lattice.window_cells - 1,
                       lattice.size.height + lattice.window_cells - 1);
  palette.classify(image, lattice.pixels(), workspace.entries);
  roots.resize(wanted.size());
  countCells(workspace.entries, lattice.step, clearedPlanes(wanted, cells, workspace));
  if (workspace.cells.empty()) return;
  const std::vector<cv::Mat1i>& sums =
      workspace.sums.compute(workspace.cells, lattice.window_cells, lattice.step * lattice.step);
  const auto side = static_cast<float>(lattice.window_cells * lattice.step);
  size_t plane = 0;
  for (size_t entry = 0; entry < wanted.size(); ++entry) {
    if (!wanted[entry]) continue;
    reuse(roots[entry], lattice.size);
    for (int row = 0; row < lattice.size.height; ++row) {
      takeRoots(sums[plane][row], side * side, lattice.size.width, roots[entry][row]);
    }
    ++plane;
  }
}

}  // namespace chain_tracker
