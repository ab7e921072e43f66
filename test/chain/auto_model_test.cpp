// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/auto_model.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/target_checks.h"

namespace chain_tracker {
namespace {

ChainModel cable(int parts) {
  ChainModel model;
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
}

TEST(WithRoomForParts, keepsPartsOfBoxesLargeEnough) {
  ChainModel model;
  model.segments[0].layout = Layout::kPlanar;
  model.segments[0].parts = 30;
  const auto boxOf = [](double size) {
    return std::vector<cv::Point2d>{
        {50, 50}, {50 + size, 50}, {50 + size, 60 + size}, {50, 60 + size}};
  };
  EXPECT_EQ(30, withRoomForParts(model, boxOf(60)).segments[0].parts);
  EXPECT_EQ(4, withRoomForParts(model, boxOf(1)).segments[0].parts);
  const ChainModel fewer = withRoomForParts(model, boxOf(10));
  EXPECT_GT(30, fewer.segments[0].parts);
  EXPECT_LT(4, fewer.segments[0].parts);
  EXPECT_TRUE(havePartsRoom(layOut(fewer, boxOf(10)), {320, 240}));
  ChainModel more = fewer;
  ++more.segments[0].parts;
  EXPECT_FALSE(havePartsRoom(layOut(more, boxOf(10)), {320, 240})) << "no more than needed";
}

TEST(WithRoomForParts, keepsPartsOfEachLinkLargeEnough) {
  ChainModel model;
  model.segment_per_edge = true;
  model.segments[0].parts = 12;
  const std::vector<cv::Point2d> joints = {{50, 50}, {60, 50}, {200, 50}};
  const ChainModel fewer = withRoomForParts(model, joints);
  EXPECT_GT(12, fewer.segments[0].parts);
  EXPECT_EQ(12, fewer.segments[1].parts);
  EXPECT_TRUE(havePartsRoom(layOut(fewer, joints), {320, 240}));
}

TEST(WithRoomForParts, refusesPointsThatAreNotThoseOfTheLinks) {
  ChainModel model = cable(20);
  model.segments.push_back(model.segments.front());
  model.joints.resize(1);
  EXPECT_THROW(withRoomForParts(model, {{0, 0}, {60, 0}}), std::invalid_argument);
}

TEST(WithRoomForParts, givesEachDeformableLinkThePartsOfItsOwnLength) {
  ChainModel model = cable(20);
  model.segment_per_edge = true;
  const ChainModel roomy = withRoomForParts(model, {{0, 0}, {60, 0}, {60, 200}});
  EXPECT_EQ(12, roomy.segments[0].parts) << "60 px * 1.2 / 6 px";
  EXPECT_EQ(20, roomy.segments[1].parts);
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
