// SPDX-License-Identifier: BSD-3-Clause
/// Moves the parts of a line along itself: an object of a single segment that bends anywhere and
/// often looks the same all along, so that its parts come to lie on what their neighbours were. Its
/// pose, outline and points stay; ObjectShape::carry() fills in the rest.
#pragma once

#include "chain_tracker/chain/chain_state.h"

namespace chain_tracker {

/// Number of hidden parts at the end of the line that has more of them: positive at its first part,
/// negative at its last one; 0 if neither end is hidden, or all of it is.
int hiddenEnd(const ChainState& line);

/// Every part goes to where the one `places` behind it is, or before it if `places` is negative;
/// those beyond the end go straight on, in steps of the last ones there, and count as visible.
/// `places`: of a smaller magnitude than there are parts, of which there are at least 2.
void slide(int places, ChainState& line);

/// The last part goes to where the first one is, and so on.
void reverse(ChainState& line);

}  // namespace chain_tracker
