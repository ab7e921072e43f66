// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/tracking_status.h"

#include <algorithm>

namespace chain_tracker {
namespace {

/// Of the usual confidence that loses an object, to find it again.
constexpr double kFoundOverLost = 1.2;

}  // namespace

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

TrackingStatus nextStatus(TrackingStatus previous, double confidence, double usual_confidence,
                          bool is_seen, const SearchModel& model) {
  const bool was_lost = previous == TrackingStatus::kLost;
  const double share = model.lost_share * usual_confidence;
  const double needed = was_lost ? std::max(model.found_above, kFoundOverLost * share)
                                 : std::max(model.lost_below, share);
  if (confidence < needed) return TrackingStatus::kLost;
  return is_seen ? TrackingStatus::kTracking : TrackingStatus::kOccluded;
}

}  // namespace chain_tracker
