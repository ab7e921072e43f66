// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/window_histograms.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <limits>

#include <opencv2/core/hal/intrin.hpp>

#include "reused_plane.h"

namespace chain_tracker {
namespace {

constexpr int kLargestByte = std::numeric_limits<uchar>::max();
constexpr size_t kCodes = 256;

/// Codes that are counted, in their order.
void listWanted(const std::vector<bool>& wanted, std::vector<size_t>& codes) {
  codes.clear();
  for (size_t code = 0; code < wanted.size(); ++code) {
    if (wanted[code]) codes.push_back(code);
  }
}

/// At (row, i * columns + column): the pixels in the cell that have the i-th wanted code. What is
/// not wanted is counted behind that.
template <typename Cell>
void countPixels(const cv::Mat1b& codes, int step, const std::vector<size_t>& wanted, int columns,
                 cv::Mat_<Cell>& plane) {
  fill(plane, Cell(0));
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

/// Counters of as many codes as a register holds that every processor has.
constexpr size_t kCounters = 16;
typedef uchar Counters __attribute__((vector_size(kCounters)));
using CounterBlock = std::array<Counters, kCounters>;

cv::v_uint8x16 load(const Counters& counters) {
  return cv::v_load(reinterpret_cast<const uchar*>(&counters));
}

void store(const cv::v_uint8x16& from, Counters& counters) {
  cv::v_store(reinterpret_cast<uchar*>(&counters), from);
}

/// One pass of a perfect shuffle: the first half of the rows interleaved with the second. After
/// four of them rows have become columns.
CounterBlock interleaved(const CounterBlock& rows) {
  CounterBlock mixed;
  for (size_t i = 0; i < kCounters / 2; ++i) {
    cv::v_uint8x16 low;
    cv::v_uint8x16 high;
    cv::v_zip(load(rows[i]), load(rows[i + kCounters / 2]), low, high);
    store(low, mixed[2 * i]);
    store(high, mixed[2 * i + 1]);
  }
  return mixed;
}

CounterBlock transposed(const CounterBlock& rows) {
  return interleaved(interleaved(interleaved(interleaved(rows))));
}

/// Cells in which up to 2 * kCounters codes are counted, cell by cell, all counters at once, none
/// of which has to wait for memory. Pays where cells have more pixels than there are counters to
/// write.
template <size_t kBlocks>
class CellCounter {
 public:
  CellCounter(const std::vector<size_t>& wanted, size_t first, size_t end) : codes_(end - first) {
    for (size_t i = first; i < end; ++i) {
      one_of_[wanted[i]][(i - first) / kCounters][(i - first) % kCounters] = 1;
    }
  }

  /// A row of cells of at most 255 pixels: the counts of the i-th code go to
  /// cells[i * columns + column].
  void countRow(const cv::Mat1b& codes, int first_row, int step, int columns, uchar* cells) const {
    constexpr int kRun = static_cast<int>(kCounters);
    for (int first = 0; first < columns; first += kRun) {
      const int run = std::min(kRun, columns - first);
      std::array<CounterBlock, kBlocks> blocks{};
      for (int i = 0; i < run; ++i) {
        const auto counts = countCell(codes, {(first + i) * step, first_row}, step);
        for (size_t b = 0; b < kBlocks; ++b) blocks[b][static_cast<size_t>(i)] = counts[b];
      }
      for (size_t b = 0; b < kBlocks; ++b) blocks[b] = transposed(blocks[b]);
      for (size_t i = 0; i < codes_; ++i) {
        std::memcpy(cells + static_cast<std::ptrdiff_t>(i) * columns + first,
                    &blocks[i / kCounters][i % kCounters], static_cast<size_t>(run));
      }
    }
  }

 private:
  using CellCounts = std::array<Counters, kBlocks>;

  CellCounts countCell(const cv::Mat1b& codes, const cv::Point& corner, int step) const {
    CellCounts counts{};
    for (int y = 0; y < step; ++y) {
      const uchar* code = codes[corner.y + y] + corner.x;
      for (int x = 0; x < step; ++x) {
        for (size_t b = 0; b < kBlocks; ++b) counts[b] += one_of_[code[x]][b];
      }
    }
    return counts;
  }

  size_t codes_;
  std::array<CellCounts, kCodes> one_of_{};
};

/// Of the wanted codes from the `first` on; at most as many as the counter holds.
template <size_t kBlocks>
void countCells(const cv::Mat1b& codes, int step, const std::vector<size_t>& wanted, size_t first,
                int columns, cv::Mat1b& plane) {
  const size_t end = std::min(first + kBlocks * kCounters, wanted.size());
  const CellCounter<kBlocks> counter(wanted, first, end);
  for (int row = 0; row < plane.rows; ++row) {
    uchar* const cells = plane[row] + static_cast<std::ptrdiff_t>(first) * columns;
    counter.countRow(codes, row * step, step, columns, cells);
  }
}

void countSmallCells(const cv::Mat1b& codes, int step, const std::vector<size_t>& wanted,
                     int columns, cv::Mat1b& plane) {
  const size_t counters = std::min(wanted.size(), 2 * kCounters);
  if (static_cast<size_t>(step) * static_cast<size_t>(step) < counters) {
    countPixels(codes, step, wanted, columns, plane);
    return;
  }
  for (size_t first = 0; first < wanted.size(); first += 2 * kCounters) {
    if (wanted.size() - first > kCounters) {
      countCells<2>(codes, step, wanted, first, columns, plane);
    } else {
      countCells<1>(codes, step, wanted, first, columns, plane);
    }
  }
}

/// Sums over the windows, the maps of workspace.codes side by side.
const cv::Mat1i& sumWindows(const cv::Mat1b& codes, const WindowLattice& lattice, int columns,
                            WindowHistogramsWorkspace& workspace) {
  const std::vector<size_t>& wanted = workspace.codes;
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
  listWanted(wanted, workspace.codes);
  const std::vector<size_t>& codes = workspace.codes;
  if (codes.empty()) return;
  const int columns = lattice.size.width + lattice.window_cells - 1;
  const cv::Mat1i& sums =
      sumWindows(pixels.codes(channel, lattice.pixels()), lattice, columns, workspace);
  for (size_t i = 0; i < codes.size(); ++i) {
    const int first = static_cast<int>(i) * columns;
    counts[codes[i]] = sums(cv::Rect({first, 0}, lattice.size));
  }
}

}  // namespace chain_tracker
