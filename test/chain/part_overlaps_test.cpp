// SPDX-License-Identifier: BSD-3-Clause
#include "chain/part_overlaps.h"

#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

/// Windows of 10 px in a row, 4 px apart: each lies on its neighbours.
std::vector<PartState> row(size_t parts, double spacing = 4.0) {
  std::vector<PartState> states(parts);
  for (size_t k = 0; k < parts; ++k) {
    states[k].position = {spacing * static_cast<double>(k), 0.0};
    states[k].side = 10.0;
  }
  return states;
}

std::vector<double> sharesOf(const PartOverlaps& overlaps, const std::vector<PartState>& parts) {
  std::vector<double> shares;
  overlaps.computeShares(parts, shares);
  return shares;
}

TEST(PartOverlaps, thoseOfTheFirstFrameDoNotCount) {
  EXPECT_EQ(std::vector<double>(5, 1.0), sharesOf(PartOverlaps(row(5)), row(5)));
}

TEST(PartOverlaps, partsThatMeetShareWhatTheySee) {
  const PartOverlaps overlaps(row(4, 20.0));
  std::vector<PartState> parts = row(4, 20.0);
  parts[3].position = parts[0].position + cv::Point2d(0.0, 4.9);
  EXPECT_EQ((std::vector<double>{0.5, 1.0, 1.0, 0.5}), sharesOf(overlaps, parts));
  parts[2].position = parts[0].position;
  EXPECT_EQ((std::vector<double>{1.0 / 3.0, 1.0, 1.0 / 3.0, 1.0 / 3.0}), sharesOf(overlaps, parts));
}

TEST(PartOverlaps, windowsThatShrinkMayComeNearer) {
  const PartOverlaps overlaps(row(3, 20.0));
  std::vector<PartState> parts = row(3, 4.0);
  EXPECT_LT(sharesOf(overlaps, parts)[1], 1.0);
  for (PartState& part : parts) part.side = 2.0;
  EXPECT_EQ(std::vector<double>(3, 1.0), sharesOf(overlaps, parts));
}

}  // namespace
}  // namespace chain_tracker
