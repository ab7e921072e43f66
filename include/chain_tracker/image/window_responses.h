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

  /// responses[plane * features + feature] of the window at every cell, exactly, for the first
  /// `count` planes, at least 1; cells outside the planes count as 0. All planes have one size; no
  /// cell exceeds `max_cell`; the responses must fit in 32 bits. The maps live until the next call;
  /// maps behind these mean nothing. Allocates nothing after the first calls for a number of cells
  /// and a size. O(planes * cells * passes).
  const std::vector<cv::Mat1i>& compute(const std::vector<CellPlane>& planes, size_t count,
                                        int window_cells, int max_cell);
  /// The same for cells of at most 255, which need no conversion.
  const std::vector<cv::Mat1i>& compute(const std::vector<cv::Mat1b>& planes, size_t count,
                                        int window_cells, int max_cell);

 private:
  struct Engine;

  Engine& engineFor(int window_cells, int max_byte, const cv::Size& size);
  void splitIntoBytes(const std::vector<CellPlane>& planes, size_t count, int bytes);
  Engine& run(const std::vector<cv::Mat1b>& planes, size_t count, int window_cells, int max_byte);

  EnsembleOf ensemble_of_;
  std::map<std::pair<int, int>, std::unique_ptr<Engine>> engines_;  ///< by cells and largest byte
  std::vector<cv::Mat1b> bytes_;  ///< the lowest of all planes, then the next ones
  std::vector<cv::Mat1i> responses_;
  std::vector<haar::BytePlane> inputs_;
  std::vector<haar::ResponsePlane> outputs_;
};

}  // namespace chain_tracker
