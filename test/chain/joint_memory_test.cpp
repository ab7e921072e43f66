// SPDX-License-Identifier: BSD-3-Clause
#include "chain/joint_memory.h"

#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

constexpr double kUsual = 0.8;
constexpr double kHidden = 0.3;

/// Segments at these orientations, all seen.
ChainState chainAt(const std::vector<double>& orientations) {
  ChainState chain;
  for (double orientation : orientations) {
    SegmentState segment;
    segment.image_from_segment.angle = orientation;
    segment.confidence = kUsual;
    chain.segments.push_back(segment);
  }
  return chain;
}

TEST(JointMemory, letsWhatIsSeenRestAnywhere) {
  JointMemory memory(chainAt({0.0, 0.5, 1.5}));
  ASSERT_EQ(2U, memory.rests().size());
  memory.observe(chainAt({0.0, 1.0, 3.0}), kUsual);
  for (const JointRest& rest : memory.rests()) EXPECT_EQ(0.0, rest.sigma);
}

TEST(JointMemory, keepsTheBendOfAJointUntilBothSegmentsAreSeenAgain) {
  JointMemory memory(chainAt({0.0, 0.5, 1.5}));
  memory.observe(chainAt({0.1, 0.7, 1.6}), kUsual);
  ChainState found = chainAt({0.2, 0.9, -2.0});
  found.segments[2].confidence = kHidden;
  for (int frame = 0; frame < 3; ++frame) {
    memory.observe(found, kUsual);
    EXPECT_EQ(0.0, memory.rests()[0].sigma);
    EXPECT_GT(memory.rests()[1].sigma, 0.0);
    EXPECT_NEAR(0.9, memory.rests()[1].angle, 1e-12);
  }
  memory.observe(chainAt({0.2, 0.9, -2.0}), kUsual);
  EXPECT_EQ(0.0, memory.rests()[1].sigma);
  EXPECT_NEAR(-2.9, memory.rests()[1].angle, 1e-12);
}

TEST(JointMemory, keepsTheBendOfTheFirstFrameOfWhatWasNeverSeen) {
  JointMemory memory(chainAt({3.0, -3.0}));
  ChainState found = chainAt({0.0, 0.0});
  found.segments[0].confidence = kHidden;
  memory.observe(found, kUsual);
  EXPECT_NEAR(2.0 * CV_PI - 6.0, memory.rests()[0].angle, 1e-12);
  EXPECT_GT(memory.rests()[0].sigma, 0.0);
}

TEST(JointMemory, ofOneSegmentIsEmpty) {
  JointMemory memory(chainAt({1.0}));
  memory.observe(chainAt({2.0}), kUsual);
  EXPECT_TRUE(memory.rests().empty());
}

}  // namespace
}  // namespace chain_tracker
