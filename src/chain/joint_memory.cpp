// SPDX-License-Identifier: BSD-3-Clause
#include "joint_memory.h"

#include <cstddef>

#include "chain_tracker/image/pixel_geometry.h"

namespace chain_tracker {
namespace {

/// Of the usual confidence: that of a segment which is seen for sure.
constexpr double kSeen = 0.8;
/// Of the bend of a joint that is not, however long [rad].
constexpr double kSigma = 0.2;

/// Of joint `m`, as JointModel counts it [rad].
double bendOf(const ChainState& chain, size_t m) {
  return wrapAngle(chain.segments[m + 1].image_from_segment.angle -
                   chain.segments[m].image_from_segment.angle);
}

}  // namespace

JointMemory::JointMemory(const ChainState& initial) : rests_(initial.segments.size() - 1) {
  for (size_t m = 0; m < rests_.size(); ++m) rests_[m].angle = bendOf(initial, m);
}

void JointMemory::observe(const ChainState& found, double usual) {
  const auto is_seen = [&](size_t m) { return found.segments[m].confidence >= kSeen * usual; };
  for (size_t m = 0; m < rests_.size(); ++m) {
    if (is_seen(m) && is_seen(m + 1)) {
      rests_[m] = {bendOf(found, m), 0.0};
    } else {
      rests_[m].sigma = kSigma;
    }
  }
}

}  // namespace chain_tracker
