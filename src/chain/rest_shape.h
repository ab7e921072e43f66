// SPDX-License-Identifier: BSD-3-Clause
/// Where the springs of a deformable segment rest (thesis ch. 3.2.2): what bends anywhere has no
/// shape of its own, only the one that it had in the frame before. Of what is hidden nobody knows
/// that shape; left alone, it would keep whatever kinks it was last pulled into.
#pragma once

#include <vector>

namespace chain_tracker {

/// `rest` becomes the directions in which the edges of a chain rest [rad], given those that they
/// had in the frame before. An edge that is seen rests as it was. Hidden ones give way, a fixed
/// share a frame, to the shape that leads on from the nearest seen edge, or from one to the other,
/// with the `turns` of each edge from the one before; where both ends are seen, the rest of the
/// turn between them is spread evenly. A chain that is hidden all along rests as it was. O(edges).
/// Needs equally many directions, flags and turns, all turns and directions in [-pi, pi]; the turn
/// of the first edge means nothing.
void restDirections(const std::vector<double>& before, const std::vector<bool>& is_hidden,
                    const std::vector<double>& turns, std::vector<double>& rest);

}  // namespace chain_tracker
