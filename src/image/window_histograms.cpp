// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/window_histograms.h"

#include <algorithm>
#include <array>
#include <cstddef>
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
void countPixels(const cv::Mat1b& codes, int step, const std::vector<size_t>& wanted, int columns,
                 cv::Mat_<Cell>& plane) {
  plane.setTo(0);
  std::array<int, kCodes> offsets;
  offsets.fill(columns * static_cast<int>(wanted.size()));
  for (size_t i = 0; i < wanted.size(); ++i) offsets[wanted[i]] = static_cast<int>(i) * columns;
  for (int y = 0; y < plane.rows * step; ++y) {
    Cell* const cells = plane[y / step];
    const uchar* code = codes[y];
    for (int column = 0; column < columns; ++column) {
      for (int i = 0; i < step; ++i) ++cells[offsets[*code++] + column];
    }
  }
}

/// Counters of as many codes as two registers hold, which every processor has.
constexpr size_t kHalf = 16;
constexpr size_t kCounters = 2 * kHalf;
typedef uchar HalfCounters __attribute__((vector_size(kHalf)));
struct Counters {
  HalfCounters first;
  HalfCounters second;
};

/// The same for codes `first` to `end` of the wanted ones, in cells of at most 255 pixels: cell by
/// cell, all counters at once, none of which has to wait for memory. Pays where cells have more
/// pixels than there are counters to write.
void countCells(const cv::Mat1b& codes, int step, const std::vector<size_t>& wanted, size_t first,
                size_t end, int columns, cv::Mat1b& plane) {
  std::array<Counters, kCodes> one_of{};
  for (size_t i = first; i < end; ++i) {
    Counters& one = one_of[wanted[i]];
    (i - first < kHalf ? one.first : one.second)[(i - first) % kHalf] = 1;
  }
  for (int row = 0; row < plane.rows; ++row) {
    uchar* const cells = plane[row] + static_cast<std::ptrdiff_t>(first) * columns;
    for (int column = 0; column < columns; ++column) {
      HalfCounters first_counts{};
      HalfCounters second_counts{};
      for (int y = row * step; y < (row + 1) * step; ++y) {
        const uchar* code = codes[y] + static_cast<std::ptrdiff_t>(column) * step;
        for (int i = 0; i < step; ++i) {
          const Counters& one = one_of[code[i]];
          first_counts += one.first;
          second_counts += one.second;
        }
      }
      uchar* cell = cells + column;
      for (size_t i = 0; i < end - first; ++i, cell += columns) {
        *cell = i < kHalf ? first_counts[i] : second_counts[i - kHalf];
      }
    }
  }
}

void countSmallCells(const cv::Mat1b& codes, int step, const std::vector<size_t>& wanted,
                     int columns, cv::Mat1b& plane) {
  const size_t counters = std::min(wanted.size(), kCounters);
  if (static_cast<size_t>(step) * static_cast<size_t>(step) < counters) {
    countPixels(codes, step, wanted, columns, plane);
    return;
  }
  for (size_t first = 0; first < wanted.size(); first += kCounters) {
    const size_t end = std::min(first + kCounters, wanted.size());
    countCells(codes, step, wanted, first, end, columns, plane);
  }
}

/// Sums over the windows, the maps of the wanted codes side by side.
const cv::Mat1i& sumWindows(const cv::Mat1b& codes, const WindowLattice& lattice,
                            const std::vector<size_t>& wanted, int columns,
                            WindowHistogramsWorkspace& workspace) {
  const int cell_area = lattice.step * lattice.step;
  const cv::Range counted(0, columns * static_cast<int>(wanted.size()));
  const auto sum = [&](auto& plane, const auto& count) -> const cv::Mat1i& {
    reuse(plane, {counted.end + columns, codes.rows / lattice.step});
    count(codes, lattice.step, wanted, columns, plane);
    return workspace.sums.compute(plane(cv::Range::all(), counted), lattice.window_cells,
                                  cell_area);
  };
  return cell_area <= kLargestByte ? sum(workspace.small_cells, countSmallCells)
                                   : sum(workspace.cells, countPixels<int>);
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
