// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/window_sums.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "support/random_inputs.h"

namespace chain_tracker {
namespace {

int slowSum(const CellPlane& cells, int window_cells, int x, int y) {
  int sum = 0;
  for (int row = y; row < std::min(y + window_cells, cells.rows); ++row) {
    for (int column = x; column < std::min(x + window_cells, cells.cols); ++column) {
      sum += cells(row, column);
    }
  }
  return sum;
}

CellPlane randomCells(RandomInputs& random, const cv::Size& size, int max_cell) {
  CellPlane cells(size);
  for (int& cell : cells) cell = random.integer(0, max_cell);
  return cells;
}

void expectSlowSums(const CellPlane& cells, int window_cells, const cv::Mat1i& sums) {
  ASSERT_EQ(cells.size(), sums.size());
  for (int y = 0; y < cells.rows; ++y) {
    for (int x = 0; x < cells.cols; ++x) {
      ASSERT_EQ(slowSum(cells, window_cells, x, y), sums(y, x)) << x << ", " << y;
    }
  }
}

TEST(WindowSums, equalSumsOverCellsForEverySizeInAnyOrder) {
  RandomInputs random(1);
  WindowSums windows;
  for (int round = 0; round < 60; ++round) {
    const cv::Size size(random.integer(1, 50), random.integer(1, 40));
    const int window_cells = random.integer(1, 9);
    // One, two and three bytes.
    const int max_cell = std::vector<int>{1, 36, 255, 256, 70000}[static_cast<size_t>(round) % 5];
    SCOPED_TRACE("round " + std::to_string(round) + ", cells up to " + std::to_string(max_cell));
    const CellPlane cells = randomCells(random, size, max_cell);
    expectSlowSums(cells, window_cells, windows.compute(cells, window_cells, max_cell));
    if (max_cell > 255) continue;
    cv::Mat1b small;
    cells.convertTo(small, CV_8U);
    expectSlowSums(cells, window_cells, windows.compute(small, window_cells, max_cell));
  }
}

}  // namespace
}  // namespace chain_tracker
