// SPDX-License-Identifier: BSD-3-Clause
/// Whether the look of something that bends anywhere tells how long it is: what looks the same all
/// along fits a shorter chain as well, and would shrink a little in every frame.
#pragma once

#include <vector>

#include "chain_tracker/chain/part_costs.h"

namespace chain_tracker {

/// How far the parts of a line, whose learned colours these are from end to end, can be told from
/// those a sixth to a quarter of it away: the share of a change of its length that is believed in
/// every frame, in [0, 1]; 0 for one colour with noise and for a single part, 1 for marks.
/// O(parts).
double lengthEvidence(const std::vector<RootHistogram>& colors);

/// Whether they can be told so well that nothing else need tell where on the line each part is.
/// O(parts).
bool isClearlyMarked(const std::vector<RootHistogram>& colors);

}  // namespace chain_tracker
