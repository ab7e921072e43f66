// SPDX-License-Identifier: BSD-3-Clause
#include "robust_costs.h"

#include <algorithm>
#include <cmath>

#include "chain_tracker/image/multiversion.h"

namespace chain_tracker {
namespace {

CHAIN_TRACKER_MULTIVERSION
void softenRow(float onset, float slope, float* __restrict costs, int columns) {
  for (int x = 0; x < columns; ++x) {
    const float cost = costs[x];
    const float softened = onset + slope * (cost - onset);
    costs[x] = cost > onset ? softened : cost;
  }
}

CHAIN_TRACKER_MULTIVERSION
void addTravelRow(float left, float step, float square_of_rows, float weight,
                  float* __restrict costs, int columns) {
  for (int x = 0; x < columns; ++x) {
    const float dx = left + step * static_cast<float>(x);
    costs[x] += weight * std::sqrt(dx * dx + square_of_rows);
  }
}

}  // namespace

void softenCosts(double onset, double slope, cv::Mat1f& costs) {
  for (int row = 0; row < costs.rows; ++row) {
    softenRow(static_cast<float>(std::max(0.0, onset)), static_cast<float>(slope), costs[row],
              costs.cols);
  }
}

void addTravelCosts(const cv::Point2d& origin, int step, const cv::Point2d& expected, double weight,
                    cv::Mat1f& costs) {
  const cv::Point2d first = origin - expected;
  for (int row = 0; row < costs.rows; ++row) {
    const double dy = first.y + row * step;
    addTravelRow(static_cast<float>(first.x), static_cast<float>(step), static_cast<float>(dy * dy),
                 static_cast<float>(weight), costs[row], costs.cols);
  }
}

}  // namespace chain_tracker
