// SPDX-License-Identifier: BSD-3-Clause
/// Whether an image belongs to the same stretch of time as the one before.
#pragma once

#include <ros/time.h>

namespace chain_tracker {

/// Stamps that go back by at most so much [s] are of images that come out of order or of a clock
/// that is corrected; a recording that starts again goes back by more.
constexpr double kStampJitter = 0.5;

/// Whether time starts again between two stamps. Zero is no stamp at all.
inline bool wentBack(const ros::Time& from, const ros::Time& to) {
  return !to.isZero() && (from - to).toSec() > kStampJitter;
}

}  // namespace chain_tracker
