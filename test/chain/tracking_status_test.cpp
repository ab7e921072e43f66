// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/tracking_status.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

const TrackingStatus kInitializing = TrackingStatus::kInitializing;
const TrackingStatus kTracking = TrackingStatus::kTracking;
const TrackingStatus kOccluded = TrackingStatus::kOccluded;
const TrackingStatus kLost = TrackingStatus::kLost;

SearchModel thresholds() {
  SearchModel model;
  model.lost_below = 0.25;
  model.found_above = 0.5;
  model.lost_share = 0.0;
  return model;
}

TrackingStatus after(TrackingStatus previous, double confidence, bool all_visible = true) {
  return nextStatus(previous, confidence, 1.0, all_visible, thresholds());
}

TEST(TrackingStatus, hasAName) {
  EXPECT_EQ("INITIALIZING", toString(kInitializing));
  EXPECT_EQ("TRACKING", toString(kTracking));
  EXPECT_EQ("OCCLUDED", toString(kOccluded));
  EXPECT_EQ("LOST", toString(kLost));
}

TEST(NextStatus, believedObjectIsKeptDownToTheLowerThreshold) {
  for (TrackingStatus previous : {kInitializing, kTracking, kOccluded}) {
    SCOPED_TRACE("from " + toString(previous));
    EXPECT_EQ(kTracking, after(previous, 1.0));
    EXPECT_EQ(kTracking, after(previous, 0.4));
    EXPECT_EQ(kTracking, after(previous, 0.25));
    EXPECT_EQ(kLost, after(previous, std::nextafter(0.25, 0.0)));
    EXPECT_EQ(kLost, after(previous, 0.0));
  }
}

TEST(NextStatus, lostObjectIsBelievedFromTheUpperThreshold) {
  EXPECT_EQ(kTracking, after(kLost, 1.0));
  EXPECT_EQ(kTracking, after(kLost, 0.5));
  EXPECT_EQ(kLost, after(kLost, std::nextafter(0.5, 0.0)));
  EXPECT_EQ(kLost, after(kLost, 0.3));
  EXPECT_EQ(kLost, after(kLost, 0.0));
}

TEST(NextStatus, hiddenPartsMakeABelievedObjectOccluded) {
  for (TrackingStatus previous : {kInitializing, kTracking, kOccluded, kLost}) {
    SCOPED_TRACE("from " + toString(previous));
    EXPECT_EQ(kOccluded, after(previous, 0.6, false));
    EXPECT_EQ(kTracking, after(previous, 0.6, true));
    EXPECT_EQ(kLost, after(previous, 0.1, false));
  }
}

TEST(NextStatus, confidenceBetweenTheThresholdsChangesNothing) {
  TrackingStatus status = kTracking;
  const std::vector<double> confidences = {0.9, 0.3, 0.2, 0.3, 0.49, 0.5, 0.3, 0.25, 0.24};
  const std::vector<TrackingStatus> expected = {kTracking, kTracking, kLost,     kLost, kLost,
                                                kTracking, kTracking, kTracking, kLost};
  for (size_t i = 0; i < confidences.size(); ++i) {
    status = after(status, confidences[i]);
    EXPECT_EQ(expected[i], status) << "frame " << i;
  }
}

TEST(NextStatus, withoutHysteresisOneThresholdServesBoth) {
  SearchModel model = thresholds();
  model.found_above = model.lost_below;
  for (TrackingStatus previous : {kTracking, kLost}) {
    EXPECT_EQ(kTracking, nextStatus(previous, 0.25, 1.0, true, model));
    EXPECT_EQ(kLost, nextStatus(previous, 0.24, 1.0, true, model));
  }
}

TEST(NextStatus, AFallFarBelowTheUsualConfidenceLosesAnObject) {
  SearchModel model;
  model.lost_below = 0.1;
  model.found_above = 0.2;
  model.lost_share = 0.3;
  EXPECT_EQ(kTracking, nextStatus(kTracking, 0.28, 0.9, true, model));
  EXPECT_EQ(kLost, nextStatus(kTracking, 0.26, 0.9, true, model));
  EXPECT_EQ(kTracking, nextStatus(kTracking, 0.11, 0.3, true, model)) << "seldom surer than that";
  EXPECT_EQ(kLost, nextStatus(kTracking, 0.09, 0.3, true, model)) << "the confidence counts, too";
  EXPECT_EQ(kLost, nextStatus(kLost, 0.32, 0.9, true, model)) << "hysteresis";
  EXPECT_EQ(kTracking, nextStatus(kLost, 0.33, 0.9, true, model));
  EXPECT_EQ(kTracking, nextStatus(kLost, 0.21, 0.3, true, model));
}

}  // namespace
}  // namespace chain_tracker
