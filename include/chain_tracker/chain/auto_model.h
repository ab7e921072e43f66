// SPDX-License-Identifier: BSD-3-Clause
/// Which shipped model a shape asks for, so that a newcomer needs none.
#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_model.h"

namespace chain_tracker {

/// "box" for the four corners of a rectangle in order, "bottle" for two ends, "articulated" for a
/// polyline whose points are joints, "cable" for any other. A quadrilateral passes for a rectangle
/// if its corners are right to within 15 degrees. Points are joints if there are at most five, as
/// nobody draws a curve with so few, or if the line turns by more than 45 degrees at each.
std::string autoModelName(const std::vector<cv::Point2d>& points);

/// forPolyline(), with fewer parts where the object is so small that their windows would be
/// narrower than 6 px in deformable segments, which keep 6 parts at least, or than 4 px in
/// rectangular ones, which keep 4 at least. Throws std::invalid_argument as layOut() if the points
/// do not suit the model.
ChainModel withRoomForParts(const ChainModel& model, const std::vector<cv::Point2d>& points);

}  // namespace chain_tracker
