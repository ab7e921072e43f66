// SPDX-License-Identifier: BSD-3-Clause
/// Where a lost object is looked for: it may have turned meanwhile.
#pragma once

#include "chain_tracker/chain/chain_model.h"
#include "chain_tracker/chain/chain_state.h"

namespace chain_tracker {

/// How far from its last orientation the object is looked for in the next frame [rad]: not at all
/// after every odd number of lost frames, else by another multiple of what the hypotheses cover,
/// nearer ones first, until all orientations have been seen. 0 for an object that is not lost.
double soughtTurn(const SegmentModel& model, int frames_lost);

/// Turns the object about the mean of its parts [rad].
void turnAboutMiddle(double turn, ChainState& state);

}  // namespace chain_tracker
