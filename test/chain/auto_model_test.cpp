// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/auto_model.h"

#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

TEST(AutoModel, TwoEndsAreABottle) { EXPECT_EQ(autoModelName({{10, 10}, {10, 90}}), "bottle"); }

TEST(AutoModel, FourCornersAreABox) {
  EXPECT_EQ(autoModelName({{10, 10}, {50, 10}, {50, 90}, {10, 90}}), "box");
  EXPECT_EQ(autoModelName({{10, 90}, {50, 90}, {50, 10}, {10, 10}}), "box") << "other winding";
  EXPECT_EQ(autoModelName({{30, 0}, {60, 30}, {30, 60}, {0, 30}}), "box") << "turned";
  EXPECT_EQ(autoModelName({{10, 10}, {50, 14}, {48, 90}, {9, 88}}), "box") << "drawn by hand";
}

TEST(AutoModel, AnyOtherPolylineIsACable) {
  EXPECT_EQ(autoModelName({{10, 10}, {50, 30}, {90, 20}}), "cable");
  EXPECT_EQ(autoModelName({{10, 10}, {50, 12}, {90, 14}, {130, 10}}), "cable") << "nearly straight";
  EXPECT_EQ(autoModelName({{10, 10}, {50, 10}, {10, 90}, {50, 90}}), "cable") << "a Z";
  EXPECT_EQ(autoModelName({{0, 0}, {40, 0}, {40, 40}, {0, 40}, {0, 5}}), "cable");
}

}  // namespace
}  // namespace chain_tracker
