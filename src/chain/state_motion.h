// SPDX-License-Identifier: BSD-3-Clause
/// Moves what is known of an object to where it may be instead. Motions are rigid (scale 1) and
/// take a point of the image [px] to another; the object's outline and points stay.
#pragma once

#include "chain_tracker/chain/chain_state.h"

namespace chain_tracker {

/// By `angle` [rad] about `center` [px], which moves to `target` [px].
Similarity rigidMotion(double angle, const cv::Point2d& center, const cv::Point2d& target);

void moveSegment(const Similarity& motion, size_t segment, ChainState& state);

/// Mean of its parts [px].
cv::Point2d middleOf(const ChainState& state);

/// From end to end [px] if its segments were in line: the sum of the diagonals of what their parts
/// bound.
double extentOf(const ChainState& state);

/// About the mean of its parts [rad].
void turnWhole(double angle, ChainState& state);

}  // namespace chain_tracker
