// SPDX-License-Identifier: BSD-3-Clause
#include "chain/chain_nodes.h"

#include <vector>

#include <gtest/gtest.h>

#include "chain_tracker/chain/chain_layout.h"

namespace chain_tracker {
namespace {

struct Arm {
  Arm() {
    ChainModel model;
    model.segments = {SegmentModel(), SegmentModel()};
    model.segments[1].name = "forearm";
    layout = layOut(model, vertices).segments;
    for (const SegmentLayout& segment : layout) {
      SegmentState segment_state;
      segment_state.image_from_segment = segment.image_from_segment;
      segment_state.first_part = static_cast<int>(state.parts.size());
      segment_state.part_count = static_cast<int>(segment.parts.size());
      for (const PartLayout& part : segment.parts) {
        PartState part_state;
        part_state.position = segment.image_from_segment.apply(part.position);
        part_state.visible = true;
        state.parts.push_back(part_state);
      }
      state.segments.push_back(segment_state);
    }
  }

  std::vector<cv::Point2d> vertices = {{100, 60}, {160, 60}, {160, 120}};
  std::vector<SegmentLayout> layout;
  ChainState state;
};

TEST(ChainNodes, leadFromTheJointBeforeOverThePartsToTheJointBehind) {
  const Arm arm;
  std::vector<cv::Point2d> nodes = {{7, 7}};
  takeNodePositions(arm.layout, arm.state, 0, nodes);
  ASSERT_EQ(arm.layout[0].parts.size() + 1, nodes.size());
  EXPECT_EQ(arm.state.parts.front().position, nodes.front());
  EXPECT_LT(cv::norm(nodes.back() - arm.vertices[1]), 1e-9);
  takeNodePositions(arm.layout, arm.state, 1, nodes);
  ASSERT_EQ(arm.layout[1].parts.size() + 1, nodes.size());
  EXPECT_LT(cv::norm(nodes.front() - arm.vertices[1]), 1e-9);
  EXPECT_EQ(arm.state.parts.back().position, nodes.back());
}

TEST(ChainNodes, jointsLieHalfwayBetweenWhereTheSegmentsHaveThem) {
  Arm arm;
  arm.state.segments[1].image_from_segment.translation += cv::Point2d(4, 2);
  EXPECT_LT(cv::norm(jointPosition(arm.layout, arm.state, 0) - cv::Point2d(162, 61)), 1e-9);
}

TEST(ChainNodes, jointsAreHiddenWithThePartBesideThem) {
  Arm arm;
  arm.state.parts[static_cast<size_t>(arm.state.segments[1].first_part)].visible = false;
  std::vector<bool> hidden = {true};
  takeNodesHidden(arm.layout[0], {arm.state, arm.state.segments[0]}, hidden);
  EXPECT_EQ(std::vector<bool>(arm.layout[0].parts.size() + 1, false), hidden);
  takeNodesHidden(arm.layout[1], {arm.state, arm.state.segments[1]}, hidden);
  std::vector<bool> expected(arm.layout[1].parts.size() + 1, false);
  expected[0] = expected[1] = true;
  EXPECT_EQ(expected, hidden);
}

}  // namespace
}  // namespace chain_tracker
