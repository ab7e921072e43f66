// SPDX-License-Identifier: BSD-3-Clause
#include "chain/line_ends.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

constexpr int kParts = 21;

/// Parts 10 px apart along +x, from x = 0 on.
SegmentLayout lineLayout(int parts = kParts) {
  SegmentLayout layout;
  layout.edges.resize(static_cast<size_t>(parts - 1));
  for (EdgeLayout& edge : layout.edges) edge.length = 10.0;
  return layout;
}

ChainState lineAsLaid(double step = 10.0, int parts = kParts) {
  ChainState line;
  line.parts.resize(static_cast<size_t>(parts));
  for (size_t k = 0; k < line.parts.size(); ++k) {
    line.parts[k].position = {step * double(k), 0.0};
    line.parts[k].visible = true;
  }
  line.segments.resize(1);
  line.segments[0].part_count = parts;
  line.segments[0].image_from_segment.scale = 1.0;
  return line;
}

double first(const ChainState& line) { return line.parts.front().position.x; }
double last(const ChainState& line) { return line.parts.back().position.x; }

TEST(LineEnds, leaveALineOfItsLengthAlone) {
  LineEnds ends(lineLayout());
  ChainState line = lineAsLaid();
  EXPECT_FALSE(ends.stretch(line));
  EXPECT_EQ(0.0, first(line));
  EXPECT_EQ(200.0, last(line));
}

TEST(LineEnds, stretchALineThatIsSqueezedBeyondEitherEnd) {
  LineEnds ends(lineLayout());
  ChainState line = lineAsLaid(8.0);
  ASSERT_TRUE(ends.stretch(line));
  EXPECT_NEAR(0.0, first(line), 1e-6);
  EXPECT_NEAR(200.0, last(line), 1e-6);
  line = lineAsLaid(8.0);
  ASSERT_TRUE(ends.stretch(line));
  EXPECT_NEAR(-40.0, first(line), 1e-6);
  EXPECT_NEAR(160.0, last(line), 1e-6);
  EXPECT_EQ(1.0, line.segments[0].image_from_segment.scale);
}

TEST(LineEnds, stretchALineThatIsHiddenAtAnEnd) {
  LineEnds ends(lineLayout());
  ChainState line = lineAsLaid();
  for (size_t k = 0; k < 5; ++k) line.parts[k].visible = false;
  ASSERT_TRUE(ends.stretch(line));
  EXPECT_NEAR(50.0, first(line), 1e-6);
  EXPECT_NEAR(250.0, last(line), 1e-6);
  EXPECT_TRUE(line.parts[0].visible);
}

TEST(LineEnds, tellNothingWhereHardlyAnythingIsSeen) {
  LineEnds ends(lineLayout());
  ChainState line = lineAsLaid();
  for (size_t k = 4; k < kParts; ++k) line.parts[k].visible = false;
  EXPECT_FALSE(ends.stretch(line));
  for (int turn = 0; turn < 4; ++turn) EXPECT_FALSE(ends.rescale(line));
}

/// Two parts longer at either end, one part shorter at either end.
TEST(LineEnds, takeTurnsInRescaling) {
  LineEnds ends(lineLayout());
  double longest = 200.0;
  double shortest = 0.0;
  int longer = 0;
  for (int turn = 0; turn < 4; ++turn) {
    ChainState line = lineAsLaid();
    ASSERT_TRUE(ends.rescale(line));
    const double length = last(line) - first(line);
    EXPECT_NEAR(length, 200.0 * line.segments[0].image_from_segment.scale, 1e-6);
    if (length > 200.0) ++longer;
    EXPECT_TRUE(std::abs(length - 220.0) < 1e-6 || std::abs(length - 190.0) < 1e-6) << length;
    longest = std::max(longest, last(line));
    shortest = std::min(shortest, first(line));
  }
  EXPECT_EQ(2, longer);
  EXPECT_NEAR(220.0, longest, 1e-6);
  EXPECT_NEAR(-20.0, shortest, 1e-6);
}

TEST(LineEnds, rescaleALineOfTwoPartsByNoMoreThanAFifth) {
  LineEnds ends(lineLayout(2));
  for (int turn = 0; turn < 4; ++turn) {
    ChainState line = lineAsLaid(10.0, 2);
    ASSERT_TRUE(ends.rescale(line));
    EXPECT_NEAR(0.2, std::abs(line.segments[0].image_from_segment.scale - 1.0), 1e-9) << turn;
  }
}

TEST(LineEnds, doNotLengthenWhatIsShort) {
  LineEnds ends(lineLayout());
  int proposals = 0;
  for (int turn = 0; turn < 4; ++turn) {
    ChainState line = lineAsLaid(8.0);
    if (!ends.rescale(line)) continue;
    ++proposals;
    EXPECT_LT(line.segments[0].image_from_segment.scale, 1.0);
  }
  EXPECT_EQ(2, proposals);
}

/// Of two lines that look as much like the object the longer one, but not at the cost of as many
/// parts as are gained.
TEST(LineEnds, scoreWhatIsLongerHigher) {
  LineEnds ends(lineLayout());
  const ChainState line = lineAsLaid();
  EXPECT_NEAR(0.8, ends.score(line, 0.8), 1e-9);
  EXPECT_GT(ends.score(lineAsLaid(11.0), 0.8), ends.score(line, 0.8));
  EXPECT_LT(ends.score(lineAsLaid(11.0), 0.8 / 1.1), ends.score(line, 0.8));
}

}  // namespace
}  // namespace chain_tracker
