// SPDX-License-Identifier: BSD-3-Clause
/// Sums over the square windows of a lattice, computed on its cells by the Haar front end: the
/// feature of a single rectangle.
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>

namespace chain_tracker {

/// Sums of pixels over cells, at least 0.
using CellPlane = cv::Mat1i;

class ResizableExecutor;

class WindowSums {
 public:
  WindowSums();
  WindowSums(WindowSums&&) noexcept;
  WindowSums& operator=(WindowSums&&) noexcept;
  ~WindowSums();

  /// sums(row, column): of the window of window_cells x window_cells whose upper left cell that is,
  /// exactly; cells outside the plane count as 0. No cell exceeds `max_cell`; the sums must fit in
  /// 32 bits. The map lives until the next call. Allocates nothing after the first calls for a
  /// number of cells and a size. O(cells).
  const cv::Mat1i& compute(const CellPlane& cells, int window_cells, int max_cell);
  /// The same for cells of at most 255, which need no conversion.
  const cv::Mat1i& compute(const cv::Mat1b& cells, int window_cells, int max_cell);

 private:
  ResizableExecutor& executorFor(int window_cells, int max_byte);

  /// By cells and largest byte.
  std::map<std::pair<int, int>, std::unique_ptr<ResizableExecutor>> executors_;
  cv::Mat1b bytes_;  ///< of one place of the cells
  std::vector<cv::Mat1i> sums_;
  std::vector<cv::Mat1i> higher_sums_;  ///< of another place than the lowest
};

}  // namespace chain_tracker
