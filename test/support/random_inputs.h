// SPDX-License-Identifier: BSD-3-Clause
/// Random inputs that are the same in every run and on every machine.
#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/edge_stencil.h"

namespace chain_tracker {

/// Costs are multiples of 1/16 below 16: sums of thousands of them are exact in single precision,
/// so fast and slow routines must agree to the last bit.
class RandomInputs {
 public:
  explicit RandomInputs(std::uint64_t seed) : generator_(seed) {}

  int integer(int low, int high) { return generator_.uniform(low, high + 1); }
  double real(double low, double high) { return generator_.uniform(low, high); }
  float cost() { return static_cast<float>(integer(0, 255)) / 16.0F; }

  /// A map of costs; about `forbidden` of the cells are +infinity.
  cv::Mat1f costs(const cv::Size& size, double forbidden = 0.0);
  std::vector<cv::Mat1f> costMaps(size_t count, const cv::Size& size, double forbidden = 0.0);

  /// Offsets of up to `reach` columns and rows, some of them twice with different costs.
  EdgeStencil stencil(int offsets, int reach);

  cv::Point2d point(double low, double high) { return {real(low, high), real(low, high)}; }
  std::vector<cv::Point2d> points(size_t count, double low, double high);

  /// An image whose every channel is noise; `type`: CV_8UC1 or CV_8UC3.
  cv::Mat noise(const cv::Size& size, int type);

 private:
  cv::RNG generator_;
};

}  // namespace chain_tracker
