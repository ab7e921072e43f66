// SPDX-License-Identifier: BSD-3-Clause
/// Colour histograms of square windows on a lattice of positions, as square roots of frequencies:
/// the form in which the Bhattacharyya coefficient of two histograms is a scalar product.
#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/image/color_palette.h"
#include "chain_tracker/image/window_responses.h"

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
  WindowHistogramsWorkspace();

  cv::Mat1b entries;
  std::vector<CellPlane> planes;  ///< as many as were ever wanted, and one for what is unwanted
  std::vector<CellPlane> cells;   ///< those of the wanted entries
  WindowResponses sums;
};

/// roots[entry](row, column) = sqrt(share of the window's pixels that have that palette entry), for
/// the entries that are wanted: maps of lattice.size. The other maps are left as they are.
/// The sums over windows are those of the Haar front end, a plane for every wanted entry.
/// `wanted` and `roots` have an element for every palette entry.
/// O(pixels + wanted entries x cells).
void computeWindowHistograms(const cv::Mat& image, const ColorPalette& palette,
                             const WindowLattice& lattice, const std::vector<bool>& wanted,
                             std::vector<cv::Mat1f>& roots, WindowHistogramsWorkspace& workspace);

}  // namespace chain_tracker
