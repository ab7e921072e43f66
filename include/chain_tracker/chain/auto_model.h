// SPDX-License-Identifier: BSD-3-Clause
/// Which shipped model a shape asks for, so that a newcomer needs none.
#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace chain_tracker {

/// "box" for the four corners of a rectangle in order, "bottle" for two ends, "cable" for any other
/// polyline. A quadrilateral passes for a rectangle if its corners are right to within 15 degrees.
std::string autoModelName(const std::vector<cv::Point2d>& points);

}  // namespace chain_tracker
