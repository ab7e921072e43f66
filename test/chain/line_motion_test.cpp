// SPDX-License-Identifier: BSD-3-Clause
#include "chain/line_motion.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

/// Parts 10 px apart along +x, from x = 0 on, each with its index for a confidence; one letter a
/// part: v where it is visible, else h.
ChainState lineOf(const std::string& seen) {
  ChainState line;
  for (size_t k = 0; k < seen.size(); ++k) {
    PartState part;
    part.position = {10.0 * double(k), 5.0};
    part.confidence = double(k);
    part.visible = seen[k] == 'v';
    line.parts.push_back(part);
  }
  line.segments.resize(1);
  line.segments[0].part_count = static_cast<int>(seen.size());
  line.segments[0].image_from_segment = {0.5, 1.0, {20.0, 5.0}};
  return line;
}

TEST(Slide, movesEveryPartToWhereAnotherWas) {
  ChainState line = lineOf("hhvvv");
  slide(2, line);
  for (size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(0.0, cv::norm(line.parts[k].position - cv::Point2d(10.0 * double(k + 2), 5.0)),
                1e-9)
        << k;
    EXPECT_TRUE(line.parts[k].visible) << k;
  }
  slide(-2, line);
  EXPECT_NEAR(0.0, cv::norm(line.parts[0].position - cv::Point2d(0.0, 5.0)), 1e-9);
  EXPECT_NEAR(0.0, cv::norm(line.parts[4].position - cv::Point2d(40.0, 5.0)), 1e-9);
}

TEST(Slide, goesOnTheWayThatTheEndLeads) {
  ChainState line = lineOf("vvvvv");
  for (size_t k = 2; k < 5; ++k) line.parts[k].position = {10.0, 10.0 * double(k) - 5.0};
  slide(1, line);
  EXPECT_NEAR(0.0, cv::norm(line.parts[4].position - cv::Point2d(10.0, 45.0)), 1e-9);
  line = lineOf("vv");
  slide(-1, line);
  EXPECT_NEAR(0.0, cv::norm(line.parts[0].position - cv::Point2d(-10.0, 5.0)), 1e-9);
  EXPECT_NEAR(0.0, cv::norm(line.parts[1].position - cv::Point2d(0.0, 5.0)), 1e-9);
}

TEST(SeenStretch, goesFromTheFirstVisiblePartToTheLast) {
  std::vector<cv::Point2d> stretch;
  takeSeenStretch(lineOf("hvhvvh"), stretch);
  ASSERT_EQ(4U, stretch.size());
  EXPECT_EQ(cv::Point2d(10.0, 5.0), stretch.front());
  EXPECT_EQ(cv::Point2d(40.0, 5.0), stretch.back());
  EXPECT_NEAR(30.0, lengthOf(stretch), 1e-9);
  takeSeenStretch(lineOf("hhh"), stretch);
  EXPECT_TRUE(stretch.empty());
  EXPECT_EQ(0.0, lengthOf(stretch));
}

TEST(SeenStretch, isHardlyLongerWhereThePartsZigzag) {
  ChainState line = lineOf("vvvvvvvvvvvvvvvvvvvvv");
  for (size_t k = 0; k < line.parts.size(); k += 2) line.parts[k].position.y += 6.0;
  std::vector<cv::Point2d> stretch;
  takeSeenStretch(line, stretch);
  EXPECT_NEAR(200.0, lengthOf(stretch), 6.0);
}

TEST(PointAlong, goesStraightOnBeyondEitherEnd) {
  const std::vector<cv::Point2d> way = {{0.0, 0.0}, {0.0, 20.0}, {15.0, 20.0}};
  const auto expect = [&](double place, const cv::Point2d& expected) {
    EXPECT_NEAR(0.0, cv::norm(pointAlong(way, place) - expected), 1e-9) << place;
  };
  expect(0.0, {0.0, 0.0});
  expect(12.0, {0.0, 12.0});
  expect(20.0, {0.0, 20.0});
  expect(30.0, {10.0, 20.0});
  // The way leads by (3, 4) to (15, 20) over its few steps.
  expect(35.0, {15.0, 20.0});
  expect(40.0, {18.0, 24.0});
  expect(-10.0, {-6.0, -8.0});
}

TEST(LayAlong, goesStraightOnBeyondTheEnd) {
  const std::vector<cv::Point2d> way = {{0.0, 0.0}, {0.0, 20.0}, {0.0, 25.0}};
  ChainState line = lineOf("vhvh");
  layAlong(way, 0.0, {10.0, 5.0, 20.0}, false, line);
  const std::vector<double> onwards = {0.0, 10.0, 15.0, 35.0};
  for (size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(0.0, cv::norm(line.parts[k].position - cv::Point2d(0.0, onwards[k])), 1e-9) << k;
    EXPECT_TRUE(line.parts[k].visible) << k;
  }
  layAlong(way, -2.0, {10.0, 5.0, 20.0}, true, line);
  const std::vector<double> backwards = {33.0, 23.0, 18.0, -2.0};
  for (size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(0.0, cv::norm(line.parts[k].position - cv::Point2d(0.0, backwards[k])), 1e-9) << k;
  }
}

TEST(LiesReversed, isWhereTheEndsAreExchanged) {
  const ChainState line = lineOf("vvvv");
  ChainState other = line;
  for (PartState& part : other.parts) part.position += cv::Point2d(12.0, 40.0);
  EXPECT_FALSE(liesReversed(other, line));
  reverse(other);
  EXPECT_TRUE(liesReversed(other, line));
}

TEST(Reverse, exchangesTheEnds) {
  ChainState line = lineOf("hvvvv");
  reverse(line);
  EXPECT_EQ(cv::Point2d(40.0, 5.0), line.parts[0].position);
  EXPECT_EQ(4.0, line.parts[0].confidence);
  EXPECT_FALSE(line.parts[4].visible);
  EXPECT_NEAR(0.5 - CV_PI, line.segments[0].image_from_segment.angle, 1e-9);
}

}  // namespace
}  // namespace chain_tracker
