// SPDX-License-Identifier: BSD-3-Clause
/// Slow twins of the fast routines. Each follows its definition word by word, over everything there
/// is, shares no code with its fast twin, and counts what it looked at: a test that finds the count
/// of an exhaustive search has not compared the fast routine with itself.
#pragma once

#include <functional>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/edge_stencil.h"
#include "chain_tracker/image/color_palette.h"
#include "chain_tracker/image/window_histograms.h"

namespace chain_tracker {
namespace brute_force {

/// Least cost of the stencil's entries with that offset; +infinity if it has none.
double stencilCost(const EdgeStencil& stencil, const cv::Point& offset);

struct ConvolvedMap {
  cv::Mat1d map;
  long long pairs = 0;  ///< of states looked at
};

/// map(q) = min over all states p of in(p) + stencilCost(stencil, q - p).
ConvolvedMap minConvolve(const cv::Mat1f& in, const EdgeStencil& stencil);

/// Cost of the edge from part k's state to part k + 1's.
using EdgeCost = std::function<double(size_t k, const cv::Point& from, const cv::Point& to)>;

EdgeCost edgeCostOf(const std::vector<EdgeStencil>& edges);

/// sum_k unary_k(q_k) + sum_k edge_k(q_k, q_{k+1}).
double energyOf(const std::vector<cv::Mat1f>& unary, const EdgeCost& edge,
                const std::vector<cv::Point>& states);

struct AllChains {
  double cost = 0.0;                 ///< of the best one; +infinity if there is none
  std::vector<cv::Mat1d> marginals;  ///< cost of the best chain through each state of each part
  long long chains = 0;              ///< looked at
};

/// Every chain of states: O(states^parts).
AllChains enumerateChains(const std::vector<cv::Mat1f>& unary, const EdgeCost& edge);

/// The spring's potential at an edge vector [px]; +infinity beyond three standard deviations of its
/// length or direction. The null vector's direction is 0.
double springCost(const EdgePotential& spring, const cv::Point2d& edge);

/// Palette entry of every pixel of the image, looked up one at a time.
cv::Mat1b entriesOf(const cv::Mat& image, const ColorPalette& palette);

struct WindowCounts {
  std::vector<int> counts;  ///< pixels with each palette entry
  int pixels = 0;           ///< looked at
};

/// Counts the pixels of the square window of `side` pixels whose top-left pixel is `corner`; those
/// outside the image are "other".
WindowCounts countWindow(const cv::Mat1b& entries, int palette_size, const cv::Point& corner,
                         int side);

}  // namespace brute_force
}  // namespace chain_tracker
