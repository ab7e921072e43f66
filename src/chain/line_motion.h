// SPDX-License-Identifier: BSD-3-Clause
/// Moves the parts of a line along itself: an object of a single segment that bends anywhere and
/// often looks the same all along, so that its parts come to lie on what their neighbours were. Its
/// pose, outline and points stay; ObjectShape::carry() fills in the rest.
#pragma once

#include <vector>

#include "chain_tracker/chain/chain_state.h"

namespace chain_tracker {

/// Every part goes to where the one `places` behind it is, or before it if `places` is negative;
/// those beyond the end go straight on, in steps of the last ones there, and count as visible.
/// `places`: of a smaller magnitude than there are parts, of which there are at least 2.
void slide(int places, ChainState& line);

/// `stretch` becomes the smoothed positions from the first visible part to the last one, as parts
/// that zigzag across a thick line do not make it longer; none if no part is visible.
void takeSeenStretch(const ChainState& line, std::vector<cv::Point2d>& stretch);

/// `place` [px] along `way`, a polyline of at least two points; straight on beyond either end.
/// O(points).
cv::Point2d pointAlong(const std::vector<cv::Point2d>& way, double place);

/// Lays all parts along `way`, as pointAlong(), at `lengths` [px] from one another, one less than
/// there are parts: the first part at `start` and its `lengths` first, or the last ones if
/// `backwards`. All count as visible. O(parts x points).
void layAlong(const std::vector<cv::Point2d>& way, double start, const std::vector<double>& lengths,
              bool backwards, ChainState& line);

/// Whether its parts are nearer to those of `before` the other way round.
bool liesReversed(const ChainState& line, const ChainState& before);

/// The last part goes to where the first one is, and so on.
void reverse(ChainState& line);

}  // namespace chain_tracker
