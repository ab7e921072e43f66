// SPDX-License-Identifier: BSD-3-Clause
/// The state machine of an object: INITIALIZING -> TRACKING <-> OCCLUDED -> LOST -> TRACKING.
#pragma once

#include <string>

#include "chain_tracker/chain/chain_model.h"

namespace chain_tracker {

enum class TrackingStatus {
  kInitializing,  ///< no frame tracked yet; the state is the one given
  kTracking,      ///< found, and seen but for little
  kOccluded,      ///< found, more than a tenth is hidden and carried by the rest
  kLost,          ///< not found; positions are the last believed ones and mean nothing now
};

/// "INITIALIZING", "TRACKING", "OCCLUDED" or "LOST".
std::string toString(TrackingStatus status);

/// The status after a frame in which the object was matched with `confidence`, which is usually
/// `usual_confidence`, both in [0, 1]: what has vanished often leaves some background that looks a
/// little like it. A LOST object needs more confidence to be believed again than a tracked one to
/// be kept (hysteresis). `is_seen`: whether (nearly) nothing of it is hidden.
TrackingStatus nextStatus(TrackingStatus previous, double confidence, double usual_confidence,
                          bool is_seen, const SearchModel& model);

}  // namespace chain_tracker
