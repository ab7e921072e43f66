// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/auto_model.h"

#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

ChainModel cable(int parts) {
  ChainModel model;
  model.segments.emplace_back();
  model.segments[0].layout = Layout::kDeformable;
  model.segments[0].parts = parts;
  model.segments[0].window = 1.2;
  return model;
}

TEST(WithRoomForParts, keepsWindowsOfDeformableSegmentsWide) {
  const std::vector<cv::Point2d> polyline = {{0, 0}, {30, 40}, {150, 40}};
  EXPECT_EQ(34, withRoomForParts(cable(48), polyline).segments[0].parts) << "170 px * 1.2 / 6 px";
  EXPECT_EQ(20, withRoomForParts(cable(20), polyline).segments[0].parts);
  EXPECT_EQ(6, withRoomForParts(cable(48), {{0, 0}, {20, 0}}).segments[0].parts);
  ChainModel box = cable(48);
  box.segments[0].layout = Layout::kPlanar;
  EXPECT_EQ(48, withRoomForParts(box, polyline).segments[0].parts);
}

TEST(AutoModel, TwoEndsAreABottle) { EXPECT_EQ(autoModelName({{10, 10}, {10, 90}}), "bottle"); }

TEST(AutoModel, FourCornersAreABox) {
  EXPECT_EQ(autoModelName({{10, 10}, {50, 10}, {50, 90}, {10, 90}}), "box");
  EXPECT_EQ(autoModelName({{10, 90}, {50, 90}, {50, 10}, {10, 10}}), "box") << "other winding";
  EXPECT_EQ(autoModelName({{30, 0}, {60, 30}, {30, 60}, {0, 30}}), "box") << "turned";
  EXPECT_EQ(autoModelName({{10, 10}, {50, 14}, {48, 90}, {9, 88}}), "box") << "drawn by hand";
}

TEST(AutoModel, FewPointsAreJoints) {
  EXPECT_EQ(autoModelName({{10, 10}, {50, 30}, {90, 20}}), "articulated");
  EXPECT_EQ(autoModelName({{10, 10}, {50, 12}, {90, 14}, {130, 10}}), "articulated")
      << "nearly straight";
  EXPECT_EQ(autoModelName({{10, 10}, {50, 10}, {10, 90}, {50, 90}}), "articulated") << "a Z";
  EXPECT_EQ(autoModelName({{0, 0}, {40, 0}, {40, 40}, {0, 40}, {0, 5}}), "articulated");
}

TEST(AutoModel, SharpTurnsEverywhereAreJoints) {
  EXPECT_EQ(autoModelName({{0, 0}, {20, 40}, {40, 0}, {60, 40}, {80, 0}, {100, 40}}),
            "articulated");
  EXPECT_EQ(autoModelName({{0, 0}, {20, 40}, {40, 0}, {60, 40}, {80, 0}, {90, -20}}), "cable");
}

TEST(AutoModel, AnyOtherPolylineIsACable) {
  EXPECT_EQ(autoModelName({{0, 0}, {20, 5}, {40, 8}, {60, 6}, {80, 1}, {100, 0}}), "cable");
}

}  // namespace
}  // namespace chain_tracker
