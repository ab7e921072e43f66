// SPDX-License-Identifier: BSD-3-Clause
/// What keeps a chain in place while something covers a part of it.
#pragma once

#include <opencv2/core.hpp>

namespace chain_tracker {

/// Costs above `onset` rise by `slope`, in [0, 1], from there on: what does not look like a part
/// anyway shall not pull it about. Negative onsets count as 0. O(states).
void softenCosts(double onset, double slope, cv::Mat1f& costs);

/// Adds `weight` for every pixel of distance between a state and `expected`; state (0, 0) is at
/// `origin` and states are `step` apart [px]. O(states).
void addTravelCosts(const cv::Point2d& origin, int step, const cv::Point2d& expected, double weight,
                    cv::Mat1f& costs);

}  // namespace chain_tracker
