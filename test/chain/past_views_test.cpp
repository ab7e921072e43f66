// SPDX-License-Identifier: BSD-3-Clause
/// Pictures in which something stands still, moves or appears.
#include "chain/past_views.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace chain_tracker {
namespace {

constexpr int kParts = 5;
constexpr int kSide = 10;
const cv::Scalar kDark(40, 40, 40);
const cv::Scalar kLight(200, 180, 160);

cv::Mat empty() { return {120, 200, CV_8UC3, kDark}; }

/// A row of parts that begins at `x`, `y`.
ChainState chainAt(double x, double y) {
  ChainState chain;
  for (int k = 0; k < kParts; ++k) {
    PartState part;
    part.position = {x + k * kSide, y};
    part.side = kSide;
    chain.parts.push_back(part);
  }
  return chain;
}

void draw(const ChainState& chain, cv::Mat& image) {
  for (const PartState& part : chain.parts) {
    const cv::Point corner(cvRound(part.position.x) - kSide / 2,
                           cvRound(part.position.y) - kSide / 2);
    cv::rectangle(image, {corner.x, corner.y, kSide, kSide}, kLight, cv::FILLED);
  }
}

cv::Mat with(const ChainState& a, const ChainState& b) {
  cv::Mat image = empty();
  draw(a, image);
  draw(b, image);
  return image;
}

class PastViewsTest : public ::testing::Test {
 protected:
  PastViewsTest() { views_.remember(with(kObject, kTwin), kObject); }

  const ChainState kObject = chainAt(20, 20);
  const ChainState kTwin = chainAt(20, 80);
  const ChainState kElsewhere = chainAt(100, 50);
  PastViews views_;
};

TEST(PastViews, NothingIsKnownAtFirst) {
  EXPECT_FALSE(PastViews().showed(chainAt(20, 20), empty()));
}

TEST_F(PastViewsTest, ATwinThatStandsStillIsKnown) {
  EXPECT_TRUE(views_.showed(kTwin, with(kElsewhere, kTwin)));
}

TEST_F(PastViewsTest, WhatHasComeIsNot) {
  EXPECT_FALSE(views_.showed(kElsewhere, with(kElsewhere, kTwin)));
}

TEST_F(PastViewsTest, TheObjectItselfMayStandStill) {
  EXPECT_FALSE(views_.showed(kObject, with(kObject, kTwin)));
}

TEST_F(PastViewsTest, ATwinThatLooksOtherwiseTellsNothing) {
  EXPECT_FALSE(views_.showed(kTwin, 1.5 * with(kElsewhere, kTwin))) << "in another light";
}

TEST_F(PastViewsTest, TheObjectIsNotTakenForWhatStoodBesideAWrongOne) {
  for (int i = 0; i < 20; ++i) views_.remember(with(kObject, kTwin), kTwin);
  EXPECT_FALSE(views_.showed(kObject, with(kObject, kElsewhere)));
}

TEST_F(PastViewsTest, AThinLineIsToldFromTheGround) {
  const auto line_at = [](double y) {
    cv::Mat image = empty();
    cv::line(image, {20, cvRound(y)}, {60, cvRound(y)}, kDark + cv::Scalar::all(60));
    return image;
  };
  PastViews views;
  views.remember(line_at(20), chainAt(20, 20));
  EXPECT_FALSE(views.showed(chainAt(20, 80), line_at(80)));
  EXPECT_TRUE(views.showed(chainAt(20, 80), line_at(20)));
}

TEST_F(PastViewsTest, MostOfTheChainHasToStandThere) {
  const ChainState moved = chainAt(20 + 2 * kSide, 80);  // three of its five parts lie on the twin
  EXPECT_TRUE(views_.showed(moved, with(kElsewhere, kTwin)));
  const ChainState farther = chainAt(20 + 3 * kSide, 80);
  EXPECT_FALSE(views_.showed(farther, with(farther, kTwin)));
}

TEST_F(PastViewsTest, PartsBeyondTheImageTellNothing) {
  EXPECT_FALSE(views_.showed(chainAt(500, 500), empty()));
}

TEST_F(PastViewsTest, TheFirstViewIsKeptAndOneOfTheLast) {
  for (int i = 0; i < 20; ++i) views_.remember(with(kTwin, kElsewhere), kTwin);
  EXPECT_TRUE(views_.showed(kTwin, with(kObject, kTwin))) << "seen in the first";
  EXPECT_TRUE(views_.showed(kElsewhere, with(kObject, kElsewhere))) << "seen in the latest";
}

}  // namespace
}  // namespace chain_tracker
