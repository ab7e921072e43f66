// SPDX-License-Identifier: BSD-3-Clause
/// How badly a part's learned histogram matches the window around each candidate position
/// (appearance term A of thesis ch. 3.2.1).
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/image/frame_pixels.h"
#include "chain_tracker/image/window_histograms.h"

namespace chain_tracker {

/// Square roots of the histogram of a part's window in the first frame, one a code of the channel.
using RootHistogram = std::vector<float>;

/// Candidate positions of all parts of a segment: equal windows of one lattice.
struct CandidateGrid {
  WindowLattice lattice;           ///< covers the candidates of all parts
  std::vector<cv::Point> corners;  ///< lattice position of each part's state (0, 0)
  cv::Size states;                 ///< of each part: columns and rows, odd

  /// Position of a part's state, which may lie between lattice points [px].
  cv::Point2d positionOf(size_t part, const cv::Point2d& state) const {
    return lattice.centerOf(corners[part].x + state.x, corners[part].y + state.y);
  }

  /// The candidates of one part alone.
  WindowLattice latticeOf(size_t part) const {
    return {lattice.origin + lattice.step * corners[part], lattice.step, lattice.window_cells,
            states};
  }

  /// Whether the lattices of the parts cover fewer pixels, all together, than the common one.
  bool isSparse() const {
    return static_cast<double>(corners.size()) * latticeOf(0).pixels().area() <
           lattice.pixels().area();
  }

  /// Position of state (0, 0) of a node that has no window, whose middle state lies nearest to
  /// `center` on the lattice [px].
  cv::Point2d originAround(const cv::Point2d& center) const;
};

/// Makes the grid's middle states lie nearest to `centers`, and all of them reach at least `radius`
/// [px] around these. `side`: of the windows [px], rounded to whole cells of `step` pixels.
void placeCandidateGrid(const std::vector<cv::Point2d>& centers, double side, int step,
                        double radius, CandidateGrid& grid);

/// Roots of the counts of a code in the windows of a lattice, as far as they were asked for.
struct CodeRoots {
  cv::Mat1f values;
  std::vector<cv::Range> taken;  ///< of each row
};

/// Kept from call to call so that no memory is allocated once sizes have settled.
struct PartCostsWorkspace {
  int threads = 1;                ///< that share the work, at least 1
  std::vector<bool> wanted;       ///< of the codes
  std::vector<cv::Mat1i> counts;  ///< of the codes
  std::vector<CodeRoots> roots;   ///< of the codes
  WindowHistogramsWorkspace histograms;
};

/// costs[k](row, column) = weight * sqrt(1 - BC), BC the Bhattacharyya coefficient of part k's
/// histogram and that of the window at that state: in [0, weight].
/// O(pixels of the lattice, or of the parts' lattices if these are fewer, + parts x states x
/// codes of a part).
void computePartCosts(FramePixels& pixels, Channel channel, const std::vector<RootHistogram>& parts,
                      const CandidateGrid& grid, double weight, std::vector<cv::Mat1f>& costs,
                      PartCostsWorkspace& workspace);

/// Histogram of the window of `side` [px], rounded, around `center`: interpolated between the
/// windows of whole pixels, so that matching finds the very centre again and not the pixel next to
/// it.
RootHistogram learnPart(FramePixels& pixels, Channel channel, const cv::Point2d& center,
                        double side);

}  // namespace chain_tracker
