// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/window_histograms.h"

#include <algorithm>
#include <array>
#include <limits>

#include "reused_plane.h"

namespace chain_tracker {
namespace {

constexpr int kLargestByte = std::numeric_limits<uchar>::max();
constexpr size_t kCodes = 256;

/// Codes that are counted, in their order.
std::vector<size_t> listWanted(const std::vector<bool>& wanted) {
  std::vector<size_t> codes;
  for (size_t code = 0; code < wanted.size(); ++code) {
    if (wanted[code]) codes.push_back(code);
  }
  return codes;
}

/// At (row, i * columns + column): the pixels in the cell that have the i-th wanted code. What is
/// not wanted is counted behind that.
template <typename Cell>
cv::Mat_<Cell> countCells(const cv::Mat1b& codes, int step, const std::vector<size_t>& wanted,
                          int columns, cv::Mat_<Cell>& plane) {
  const int width = columns * static_cast<int>(wanted.size());
  reuse(plane, {width + columns, codes.rows / step});
  plane.setTo(0);
  std::array<int, kCodes> offsets;
  offsets.fill(width);
  for (size_t i = 0; i < wanted.size(); ++i) offsets[wanted[i]] = static_cast<int>(i) * columns;
  for (int y = 0; y < plane.rows * step; ++y) {
    Cell* const cells = plane[y / step];
    const uchar* code = codes[y];
    for (int column = 0; column < columns; ++column) {
      for (int i = 0; i < step; ++i) ++cells[offsets[*code++] + column];
    }
  }
  return plane.colRange(0, width);
}

/// Sums over the windows, the maps of the wanted codes side by side.
const cv::Mat1i& sumWindows(const cv::Mat1b& codes, const WindowLattice& lattice,
                            const std::vector<size_t>& wanted, int columns,
                            WindowHistogramsWorkspace& workspace) {
  const int cell_area = lattice.step * lattice.step;
  const auto sum = [&](auto& plane) -> const cv::Mat1i& {
    const auto counts = countCells(codes, lattice.step, wanted, columns, plane);
    return workspace.sums.compute(counts, lattice.window_cells, cell_area);
  };
  return cell_area <= kLargestByte ? sum(workspace.small_cells) : sum(workspace.cells);
}

}  // namespace

void computeWindowHistograms(FramePixels& pixels, Channel channel, const WindowLattice& lattice,
                             const std::vector<bool>& wanted, std::vector<cv::Mat1i>& counts,
                             WindowHistogramsWorkspace& workspace) {
  counts.resize(wanted.size());
  const std::vector<size_t> codes = listWanted(wanted);
  if (codes.empty()) return;
  const int columns = lattice.size.width + lattice.window_cells - 1;
  const cv::Mat1i& sums =
      sumWindows(pixels.codes(channel, lattice.pixels()), lattice, codes, columns, workspace);
  for (size_t i = 0; i < codes.size(); ++i) {
    const int first = static_cast<int>(i) * columns;
    counts[codes[i]] = sums(cv::Rect({first, 0}, lattice.size));
  }
}

}  // namespace chain_tracker
