// SPDX-License-Identifier: BSD-3-Clause
/// How the joints of a chain were bent when they were last seen. A link that something hides would
/// else turn to whatever beside it looks like it, as a finger does to the palm.
#pragma once

#include <vector>

#include "chain_tracker/chain/chain_state.h"
#include "chain_tracker/chain/pose_grid.h"

namespace chain_tracker {

class JointMemory {
 public:
  explicit JointMemory(const ChainState& initial);

  /// To be called with every chain that was taken for the object. `usual`: its usual confidence, of
  /// which a segment that is seen has most.
  void observe(const ChainState& found, double usual);

  /// Of each joint, one fewer than segments: those with both segments seen rest at any angle.
  const std::vector<JointRest>& rests() const { return rests_; }

 private:
  std::vector<JointRest> rests_;
};

}  // namespace chain_tracker
