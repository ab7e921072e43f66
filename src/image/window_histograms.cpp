// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/window_histograms.h"

#include <algorithm>
#include <limits>

#include "reused_plane.h"

namespace chain_tracker {
namespace {

constexpr int kLargestByte = std::numeric_limits<uchar>::max();

/// The whole window.
haar::FeatureEnsemble windowSum(int window_cells) {
  return {"window", {{"sum", {{0, 0, window_cells, window_cells, 1}}}}};
}

/// planes[entry](row, column) += number of pixels with that entry in the cell.
template <typename Cell>
void countCells(const cv::Mat1b& entries, int step, const std::vector<cv::Mat_<Cell>*>& planes) {
  const int columns = entries.cols / step;
  std::vector<Cell*> rows(planes.size());
  for (int y = 0; y < entries.rows; ++y) {
    for (size_t b = 0; b < planes.size(); ++b) rows[b] = (*planes[b])[y / step];
    const uchar* entry = entries[y];
    for (int column = 0; column < columns; ++column) {
      for (int i = 0; i < step; ++i) ++rows[*entry++][column];
    }
  }
}

/// Empty cells: for each entry its plane, which for all unwanted ones is the last.
template <typename Cell>
std::vector<cv::Mat_<Cell>*> clearedPlanes(const std::vector<bool>& wanted, const cv::Size& cells,
                                           std::vector<cv::Mat_<Cell>>& planes) {
  const auto count = static_cast<size_t>(std::count(wanted.begin(), wanted.end(), true));
  planes.resize(std::max(planes.size(), count + 1));
  for (size_t i = 0; i <= count; ++i) {
    reuse(planes[i], cells);
    for (int row = 0; row < cells.height; ++row) {
      std::fill(planes[i][row], planes[i][row] + cells.width, Cell());
    }
  }
  std::vector<cv::Mat_<Cell>*> of_entries;
  of_entries.reserve(wanted.size());
  auto next = planes.begin();
  for (const bool is_wanted : wanted) of_entries.push_back(is_wanted ? &*next++ : &planes[count]);
  return of_entries;
}

/// Sums over the windows, a map for every wanted entry.
template <typename Cell>
const std::vector<cv::Mat1i>& sumWindows(const WindowLattice& lattice,
                                         const std::vector<bool>& wanted,
                                         std::vector<cv::Mat_<Cell>>& planes,
                                         WindowHistogramsWorkspace& workspace) {
  const cv::Size cells(lattice.size.width + lattice.window_cells - 1,
                       lattice.size.height + lattice.window_cells - 1);
  countCells(workspace.entries, lattice.step, clearedPlanes(wanted, cells, planes));
  const auto count = static_cast<size_t>(std::count(wanted.begin(), wanted.end(), true));
  return workspace.sums.compute(planes, count, lattice.window_cells, lattice.step * lattice.step);
}

}  // namespace

WindowHistogramsWorkspace::WindowHistogramsWorkspace() : sums(windowSum) {}

void computeWindowHistograms(const cv::Mat& image, const ColorPalette& palette,
                             const WindowLattice& lattice, const std::vector<bool>& wanted,
                             std::vector<cv::Mat1i>& counts, WindowHistogramsWorkspace& workspace) {
  counts.resize(wanted.size());
  if (std::find(wanted.begin(), wanted.end(), true) == wanted.end()) return;
  palette.classify(image, lattice.pixels(), workspace.entries);
  const bool is_small = lattice.step * lattice.step <= kLargestByte;
  const std::vector<cv::Mat1i>& sums =
      is_small ? sumWindows(lattice, wanted, workspace.small_planes, workspace)
               : sumWindows(lattice, wanted, workspace.planes, workspace);
  auto next = sums.begin();
  for (size_t entry = 0; entry < wanted.size(); ++entry) {
    if (wanted[entry]) counts[entry] = *next++;
  }
}

}  // namespace chain_tracker
