// SPDX-License-Identifier: BSD-3-Clause
/// What it costs by colours to have some parts of an object anywhere in a wide region, on a coarse
/// map: where to look for an object that is not where it was.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_model.h"
#include "chain_tracker/chain/part_costs.h"

namespace chain_tracker {

/// A part that is asked.
struct Voter {
  cv::Point2d position;       ///< where the object was [px]
  RootHistogram colors;       ///< that it is to show
  double outlier_cost = 0.0;  ///< from which on it shows something else
  float known = 1.0F;         ///< share of the window that is known to show them
};

/// Where the centres of windows may be.
struct CellMap {
  cv::Point2d first;  ///< centre of cell (0, 0) [px]
  int step = 1;       ///< [px]
  cv::Size size;

  cv::Point cellOf(const cv::Point2d& position) const { return (position - first) / step; }
  cv::Point2d centerOf(const cv::Point& cell) const { return first + cv::Point2d(cell) * step; }
  bool contain(const cv::Point& cell) const { return cv::Rect(cv::Point(), size).contains(cell); }
};

/// Of each voter with its window in each cell, softened beyond its outlier cost. `side`: of the
/// windows [px]. O(voters x cells).
std::vector<cv::Mat1f> voterCosts(const std::vector<Voter>& voters, double side,
                                  const CellMap& cells, const AppearanceModel& model,
                                  FramePixels& pixels, PartCostsWorkspace& workspace);

/// Of voter `k` at `position`, out of `costs` of all: off the map it is hidden.
double costAt(const cv::Point2d& position, size_t k, const std::vector<Voter>& voters,
              const CellMap& cells, const std::vector<cv::Mat1f>& costs);

}  // namespace chain_tracker
