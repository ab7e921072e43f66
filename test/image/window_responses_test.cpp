// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/window_responses.h"

#include <gtest/gtest.h>

#include "support/random_inputs.h"

namespace chain_tracker {
namespace {

/// The window, and its first row against its first cell.
haar::FeatureEnsemble someFeatures(int window_cells) {
  return {"some",
          {{"sum", {{0, 0, window_cells, window_cells, 1}}},
           {"row", {{0, 0, window_cells, 1, 1}, {0, 0, 1, 1, -3}}}}};
}

int cellAt(const CellPlane& cells, int x, int y) {
  return x < cells.cols && y < cells.rows ? cells(y, x) : 0;
}

std::vector<int> slowResponses(const CellPlane& cells, int window_cells, int x, int y) {
  int sum = 0;
  int row = -3 * cellAt(cells, x, y);
  for (int i = 0; i < window_cells; ++i) {
    row += cellAt(cells, x + i, y);
    for (int j = 0; j < window_cells; ++j) sum += cellAt(cells, x + i, y + j);
  }
  return {sum, row};
}

CellPlane randomCells(RandomInputs& random, const cv::Size& size, int max_cell) {
  CellPlane cells(size);
  for (int& cell : cells) cell = random.integer(0, max_cell);
  return cells;
}

void expectSlowResponses(const CellPlane& cells, int window_cells,
                         const std::vector<cv::Mat1i>& responses) {
  ASSERT_LE(2U, responses.size());
  for (int y = 0; y < cells.rows; ++y) {
    for (int x = 0; x < cells.cols; ++x) {
      const std::vector<int> expected = slowResponses(cells, window_cells, x, y);
      ASSERT_EQ(expected[0], responses[0](y, x)) << x << ", " << y;
      ASSERT_EQ(expected[1], responses[1](y, x)) << x << ", " << y;
    }
  }
}

TEST(WindowResponses, equalSumsOverCellsForEverySizeInAnyOrder) {
  RandomInputs random(1);
  WindowResponses windows(someFeatures);
  for (int round = 0; round < 60; ++round) {
    const cv::Size size(random.integer(1, 50), random.integer(1, 40));
    const int window_cells = random.integer(2, 9);
    // One, two and three bytes.
    const int max_cell = std::vector<int>{1, 36, 255, 256, 70000}[static_cast<size_t>(round) % 5];
    SCOPED_TRACE("round " + std::to_string(round) + ", cells up to " + std::to_string(max_cell));
    const CellPlane cells = randomCells(random, size, max_cell);
    expectSlowResponses(cells, window_cells, windows.compute(cells, window_cells, max_cell));
    if (max_cell > 255) continue;
    cv::Mat1b small;
    cells.convertTo(small, CV_8U);
    expectSlowResponses(cells, window_cells, windows.compute(small, window_cells, max_cell));
  }
}

}  // namespace
}  // namespace chain_tracker
