// SPDX-License-Identifier: BSD-3-Clause
/// The direction in which brightness rises across each pixel, as one of a few codes that histograms
/// can count (after the oriented gradients of Dalal and Triggs, CVPR 2005). The gradient is the
/// responses of two Haar-like features of two rectangles each, computed by the front end.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <opencv2/core.hpp>

namespace chain_tracker {

/// Code of pixels without an edge, and of all that lies outside the image.
constexpr std::uint8_t kNoEdge = 0;
/// kNoEdge and eight directions: 1 along +x, then every 45 degrees towards +y.
constexpr int kEdgeCodes = 9;
/// |right| + |down| of an edge, at least [grey levels across two pixels]; less is noise.
constexpr int kLeastContrast = 10;

/// Code of the gradient (right, down), each a sum over three pixels of the difference across two:
/// the nearest of the eight directions, to half a degree.
int edgeCode(float right, float down);

class ResizableExecutor;

class EdgeDirections {
 public:
  EdgeDirections();
  EdgeDirections(EdgeDirections&&) noexcept;
  EdgeDirections& operator=(EdgeDirections&&) noexcept;
  ~EdgeDirections();

  /// The region whose grey levels tell the gradients of another one: a pixel larger on all sides.
  static cv::Rect neededFor(const cv::Rect& region);

  /// The gradients, {right, down}, of a region whose neededFor() is `grey`. The planes live until
  /// the next call. O(pixels).
  const std::vector<cv::Mat1i>& gradients(const cv::Mat1b& grey);

  /// The codes of that region, written to `codes`, which has its size.
  void compute(const cv::Mat1b& grey, cv::Mat1b& codes);

 private:
  std::unique_ptr<ResizableExecutor> executor_;
  std::vector<cv::Mat1i> responses_;
  std::vector<cv::Mat1i> gradients_;  ///< the inner parts of those
};

}  // namespace chain_tracker
