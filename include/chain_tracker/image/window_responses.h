// SPDX-License-Identifier: BSD-3-Clause
/// Haar-like features of the windows of a lattice, computed on its cells by the Haar front end.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/haar/buffered_executor.h"

namespace chain_tracker {

/// Sums of pixels over cells, at least 0.
using CellPlane = cv::Mat1i;

class WindowResponses {
 public:
  /// The features of a window of so many cells; (0, 0) is its upper left cell.
  using EnsembleOf = std::function<haar::FeatureEnsemble(int window_cells)>;

  explicit WindowResponses(EnsembleOf ensemble_of);
  WindowResponses(WindowResponses&&) noexcept;
  WindowResponses& operator=(WindowResponses&&) noexcept;
  ~WindowResponses();

  /// responses[feature] of the window at every cell, exactly; cells outside the plane count as 0.
  /// No cell exceeds `max_cell`; the responses must fit in 32 bits. The maps live until the next
  /// call; maps behind these mean nothing. Allocates nothing after the first calls for a number of
  /// cells and a size. O(cells * passes).
  const std::vector<cv::Mat1i>& compute(const CellPlane& cells, int window_cells, int max_cell);
  /// The same for cells of at most 255, which need no conversion.
  const std::vector<cv::Mat1i>& compute(const cv::Mat1b& cells, int window_cells, int max_cell);

 private:
  struct Engine;

  Engine& engineFor(int window_cells, int max_byte, const cv::Size& size);
  void addPlane(const cv::Mat1b& plane);
  Engine& run(int window_cells, int max_byte, const cv::Size& size);

  EnsembleOf ensemble_of_;
  std::map<std::pair<int, int>, std::unique_ptr<Engine>> engines_;  ///< by cells and largest byte
  std::vector<cv::Mat1b> bytes_;  ///< of the cells, the lowest ones first
  std::vector<cv::Mat1i> responses_;
  std::vector<haar::BytePlane> inputs_;
  std::vector<haar::ResponsePlane> outputs_;
};

}  // namespace chain_tracker
