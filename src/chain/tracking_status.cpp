// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/tracking_status.h"

namespace chain_tracker {

std::string toString(TrackingStatus status) {
  switch (status) {
    case TrackingStatus::kInitializing:
      return "INITIALIZING";
    case TrackingStatus::kTracking:
      return "TRACKING";
    case TrackingStatus::kOccluded:
      return "OCCLUDED";
    case TrackingStatus::kLost:
      return "LOST";
  }
  return "UNKNOWN";
}

TrackingStatus nextStatus(TrackingStatus previous, double confidence, bool is_seen,
                          const SearchModel& model) {
  const bool was_lost = previous == TrackingStatus::kLost;
  const double needed = was_lost ? model.found_above : model.lost_below;
  if (confidence < needed) return TrackingStatus::kLost;
  return is_seen ? TrackingStatus::kTracking : TrackingStatus::kOccluded;
}

}  // namespace chain_tracker
