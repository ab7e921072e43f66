// SPDX-License-Identifier: BSD-3-Clause
/// Histograms of square windows on a lattice of positions: of colours, or of the directions of
/// edges.
#pragma once

#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/image/frame_pixels.h"
#include "chain_tracker/image/window_sums.h"

namespace chain_tracker {

/// Where windows are looked at. The image is cut into cells of step x step pixels, counted from
/// `origin`; the window at (column, row) covers `window_cells` cells to the right and down.
struct WindowLattice {
  cv::Point origin;      ///< top-left pixel of cell (0, 0); may lie outside the image
  int step = 1;          ///< side of a cell [px]
  int window_cells = 1;  ///< side of a window [cells]
  cv::Size size;         ///< window positions: columns and rows

  /// Centre of the window at (column, row) [px].
  cv::Point2d centerOf(double column, double row) const {
    const double half = 0.5 * (window_cells * step - 1);
    return {origin.x + step * column + half, origin.y + step * row + half};
  }
  /// All pixels that any window covers.
  cv::Rect pixels() const {
    return {origin, cv::Size((size.width + window_cells - 1) * step,
                             (size.height + window_cells - 1) * step)};
  }
};

/// Memory that may be kept from call to call so that none is allocated.
struct WindowHistogramsWorkspace {
  std::vector<size_t> codes;  ///< those that are counted
  cv::Mat1b small_cells;      ///< the counts of all wanted entries side by side
  CellPlane cells;            ///< the same for cells of more than 255 pixels
  WindowSums sums;
};

/// counts[code](row, column): pixels of the window that have that code of the channel, for the
/// codes that are wanted: maps of lattice.size, valid until the workspace is used again. The other
/// maps mean nothing.
/// The sums over windows are those of the Haar front end, on the cells of all wanted codes side by
/// side: one wide plane takes less time than many narrow ones. `wanted` has an element for every
/// code. O(pixels + wanted codes x cells).
void computeWindowHistograms(FramePixels& pixels, Channel channel, const WindowLattice& lattice,
                             const std::vector<bool>& wanted, std::vector<cv::Mat1i>& counts,
                             WindowHistogramsWorkspace& workspace);

}  // namespace chain_tracker
