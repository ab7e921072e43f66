// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "chain_tracker/chain/chain_layout.h"
#include "support/refusal.h"

namespace chain_tracker {
namespace {

std::string layoutRefusal(Layout layout, const std::vector<cv::Point2d>& points) {
  ChainModel model;
  model.segments[0].name = "seg";
  model.segments[0].layout = layout;
  return refusalOf([&] { layOut(model, points); });
}

TEST(LayOut, refusesAWrongNumberOfPoints) {
  const auto somePoints = [](size_t count) {
    std::vector<cv::Point2d> points;
    for (size_t i = 0; i < count; ++i) points.emplace_back(30.0 * double(i), 10.0 * double(i * i));
    return points;
  };
  for (size_t count : {0U, 1U, 3U, 5U, 9U}) {
    const std::string refusal = layoutRefusal(Layout::kElongated, somePoints(count));
    EXPECT_EQ("", omissionsOf(refusal, {"seg", std::to_string(count), "2 ends", "4 corners"}));
  }
  for (size_t count : {0U, 1U, 2U, 3U, 5U}) {
    const std::string refusal = layoutRefusal(Layout::kPlanar, somePoints(count));
    EXPECT_EQ("", omissionsOf(refusal, {"seg", std::to_string(count), "4 corners"}));
  }
  for (size_t count : {0U, 1U}) {
    for (Layout layout : {Layout::kDeformable, Layout::kPoints}) {
      const std::string refusal = layoutRefusal(layout, somePoints(count));
      EXPECT_EQ("", omissionsOf(refusal, {"seg", std::to_string(count), "at least 2"}));
    }
  }
}

TEST(LayOut, refusesPointsThatCoincide) {
  EXPECT_EQ("", omissionsOf(layoutRefusal(Layout::kElongated, {{5, 7}, {5, 7}}),
                            {"0", "1", "(5, 7)", "1 px"}));
  EXPECT_EQ("", omissionsOf(layoutRefusal(Layout::kElongated, {{5, 7}, {5.5, 7}}), {"(5, 7)"}));
  EXPECT_EQ("", omissionsOf(layoutRefusal(Layout::kPlanar, {{5, 7}, {50, 7}, {50, 70}, {50, 70.2}}),
                            {"2", "3", "(50, 70)"}));
  EXPECT_EQ("", omissionsOf(layoutRefusal(Layout::kDeformable, {{5, 7}, {50, 7}, {50, 7}}),
                            {"1", "2", "(50, 7)"}));
  EXPECT_EQ("", layoutRefusal(Layout::kElongated, {{5, 7}, {6, 7}}));
}

TEST(LayOut, refusesPointsThatAreNotFinite) {
  for (double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    for (Layout layout : {Layout::kElongated, Layout::kDeformable, Layout::kPoints}) {
      EXPECT_EQ("", omissionsOf(layoutRefusal(layout, {{bad, 7}, {50, 7}}), {"point 0", "finite"}));
      EXPECT_EQ(
          "", omissionsOf(layoutRefusal(layout, {{5, 7}, {50, bad}}), {"point 1", "50", "finite"}));
    }
  }
}

TEST(LayOut, refusesCornersThatEncloseNoArea) {
  const std::vector<cv::Point2d> on_a_line = {{0, 0}, {10, 10}, {20, 20}, {30, 30}};
  const std::vector<cv::Point2d> crossed = {{0, 0}, {40, 40}, {40, 0}, {0, 40}};
  for (const auto& corners : {on_a_line, crossed}) {
    EXPECT_EQ("", omissionsOf(layoutRefusal(Layout::kPlanar, corners),
                              {"corners", "(0, 0)", "no area", "in order"}));
  }
}

/// A polyline may go back over itself: parts then lie on top of each other.
TEST(LayOut, takesAPolylineThatDoublesBack) {
  ChainModel model;
  model.segments[0].layout = Layout::kDeformable;
  model.segments[0].parts = 4;
  const SegmentLayout segment = layOut(model, {{0, 0}, {60, 0}, {0, 0}}).segments[0];
  const std::vector<double> expected = {0.0, 40.0, 40.0, 0.0};
  for (size_t k = 0; k < 4; ++k) {
    const cv::Point2d position = segment.image_from_segment.apply(segment.parts[k].position);
    EXPECT_NEAR(expected[k], position.x, 1e-9) << "part " << k;
    EXPECT_NEAR(0.0, position.y, 1e-9) << "part " << k;
  }
}

}  // namespace
}  // namespace chain_tracker
