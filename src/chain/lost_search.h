// SPDX-License-Identifier: BSD-3-Clause
/// Where an object is looked for that is not where it is expected: it may have turned meanwhile.
#pragma once

#include "chain_tracker/chain/chain_model.h"
#include "chain_tracker/chain/chain_state.h"

namespace chain_tracker {

/// The turn to the next orientation that the hypotheses do not cover [rad].
double sweepStep(const SegmentModel& model);

/// How far from its last orientation the object is looked for after so many searches in vain [rad]:
/// not at all after an odd number of them, else by another multiple of sweepStep(), nearer ones
/// first, until all orientations have been seen. 0 after none.
double soughtTurn(const SegmentModel& model, int failures);

/// Turns the object about the mean of its parts [rad].
void turnAboutMiddle(double turn, ChainState& state);

}  // namespace chain_tracker
