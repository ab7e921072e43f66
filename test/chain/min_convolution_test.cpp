// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/min_convolution.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "support/brute_force.h"
#include "support/guarded_map.h"
#include "support/map_difference.h"
#include "support/random_inputs.h"

namespace chain_tracker {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

cv::Mat1f convolve(const cv::Mat1f& in, const EdgeStencil& stencil) {
  cv::Mat1f out;
  MinConvolution convolution;
  convolution.setStencil(stencil, in.size());
  convolution.run(in, cv::Mat1f(in.size(), 0.0F), out);
  return out;
}

std::string differenceFromSlowTwin(const cv::Mat1f& in, const EdgeStencil& stencil) {
  return firstDifference(brute_force::minConvolve(in, stencil).map, convolve(in, stencil));
}

/// Smaller than a block of outputs, exactly one, one more, lines, and awkward ones.
std::vector<cv::Size> hostileSizes() {
  return {{1, 1}, {1, 9}, {9, 1}, {1, 2},  {3, 3},  {7, 3},   {8, 4},
          {9, 5}, {8, 5}, {9, 4}, {16, 8}, {17, 9}, {33, 35}, {40, 6}};
}

std::string textOf(const cv::Size& size) {
  return std::to_string(size.width) + " columns x " + std::to_string(size.height) + " rows";
}

TEST(MinConvolution, slowTwinLooksAtEveryPairOfStates) {
  const cv::Mat1f in(5, 7, 1.0F);
  EXPECT_EQ(35 * 35, brute_force::minConvolve(in, {{0, 0, 0.0F}}).pairs);
}

TEST(MinConvolution, equalsSlowTwinOnHostileSizes) {
  RandomInputs random(1);
  for (const cv::Size& size : hostileSizes()) {
    SCOPED_TRACE(textOf(size));
    for (int reach : {0, 1, 3, 12, 50}) {
      SCOPED_TRACE("offsets up to " + std::to_string(reach));
      const cv::Mat1f in = random.costs(size);
      EXPECT_EQ("", differenceFromSlowTwin(in, random.stencil(25, reach)));
    }
  }
}

TEST(MinConvolution, equalsSlowTwinWithForbiddenStates) {
  RandomInputs random(2);
  for (const cv::Size& size : hostileSizes()) {
    SCOPED_TRACE(textOf(size));
    for (double forbidden : {0.3, 0.9}) {
      const cv::Mat1f in = random.costs(size, forbidden);
      EXPECT_EQ("", differenceFromSlowTwin(in, random.stencil(12, 4)));
    }
  }
}

TEST(MinConvolution, equalsSlowTwinForOneOffsetAtATime) {
  RandomInputs random(3);
  const cv::Mat1f in = random.costs({9, 6});
  for (int rows = -7; rows <= 7; ++rows) {
    for (int columns = -10; columns <= 10; ++columns) {
      SCOPED_TRACE("offset " + std::to_string(columns) + ", " + std::to_string(rows));
      EXPECT_EQ("", differenceFromSlowTwin(in, {{columns, rows, 0.5F}}));
    }
  }
}

TEST(MinConvolution, offsetPointsFromTheInputToTheOutput) {
  cv::Mat1f in(6, 6, kInfinity);
  in(2, 1) = 3.0F;
  const cv::Mat1f out = convolve(in, {{3, -1, 0.5F}});
  cv::Mat1f expected(6, 6, kInfinity);
  expected(1, 4) = 3.5F;
  EXPECT_EQ("", firstDifference(expected, out));
}

TEST(MinConvolution, equalCostsStayEqualWhereTheStencilReaches) {
  const cv::Mat1f in(5, 5, 2.0F);
  const cv::Mat1f out = convolve(in, {{1, 0, 0.25F}, {-1, 0, 0.25F}});
  EXPECT_EQ("", firstDifference(cv::Mat1f(5, 5, 2.25F), out));
}

TEST(MinConvolution, emptyStencilReachesNothing) {
  const cv::Mat1f in(4, 9, 1.0F);
  EXPECT_EQ("", firstDifference(cv::Mat1f(4, 9, kInfinity), convolve(in, {})));
}

TEST(MinConvolution, offsetsLargerThanTheMapReachNothing) {
  const cv::Mat1f in(4, 9, 1.0F);
  const EdgeStencil beyond = {{9, 0, 0.0F},  {-9, 0, 0.0F},      {0, 4, 0.0F},
                              {0, -4, 0.0F}, {1000000, 0, 0.0F}, {0, -1000000, 0.0F}};
  EXPECT_EQ("", firstDifference(cv::Mat1f(4, 9, kInfinity), convolve(in, beyond)));
}

TEST(MinConvolution, forbiddenInputsAndForbiddenOffsetsGiveInfinityNotNan) {
  const cv::Mat1f forbidden(3, 9, kInfinity);
  const cv::Mat1f out = convolve(forbidden, {{0, 0, 1.0F}, {1, 0, kInfinity}});
  for (float cost : out) ASSERT_TRUE(std::isinf(cost) && cost > 0.0F) << cost;
}

TEST(MinConvolution, readsAndWritesNothingAroundItsMaps) {
  RandomInputs random(4);
  for (const cv::Size& size : hostileSizes()) {
    SCOPED_TRACE(textOf(size));
    // A read beyond the input would find the best cost of all.
    GuardedMap in(size, -1000.0F);
    GuardedMap out(size, 77.0F);
    GuardedMap added(size, -1000.0F);
    random.costs(size).copyTo(in.map());
    added.map().setTo(0.0F);
    const EdgeStencil stencil = random.stencil(20, 6);
    MinConvolution convolution;
    convolution.setStencil(stencil, size);
    convolution.run(in.map(), added.map(), out.map());
    ASSERT_TRUE(out.holds(out.map())) << "the output was allocated anew";
    EXPECT_EQ("", firstDifference(brute_force::minConvolve(in.map(), stencil).map, out.map()));
    EXPECT_EQ("", in.damage());
    EXPECT_EQ("", added.damage());
    EXPECT_EQ("", out.damage());
  }
}

TEST(MinConvolution, addsWhatTheReceiverSays) {
  RandomInputs random(8);
  for (const cv::Size& size : hostileSizes()) {
    SCOPED_TRACE(textOf(size));
    const cv::Mat1f in = random.costs(size, 0.1);
    const cv::Mat1f added = random.costs(size, 0.1);
    const EdgeStencil stencil = random.stencil(12, 4);
    MinConvolution convolution;
    convolution.setStencil(stencil, size);
    cv::Mat1f out;
    convolution.run(in, added, out);
    cv::Mat1d expected;
    cv::add(brute_force::minConvolve(in, stencil).map, added, expected, cv::noArray(), CV_64F);
    EXPECT_EQ("", firstDifference(expected, out, 1e-4));
  }
}

TEST(MinConvolution, ofAnotherSizeLeavesNoTrace) {
  RandomInputs random(5);
  MinConvolution convolution;
  cv::Mat1f out;
  for (const cv::Size& size : {cv::Size(20, 20), cv::Size(3, 2), cv::Size(11, 30)}) {
    SCOPED_TRACE(textOf(size));
    const EdgeStencil stencil = random.stencil(10, 5);
    convolution.setStencil(stencil, size);
    for (int repeat = 0; repeat < 2; ++repeat) {
      const cv::Mat1f in = random.costs(size, 0.2);
      convolution.run(in, cv::Mat1f(size, 0.0F), out);
      EXPECT_EQ("", firstDifference(brute_force::minConvolve(in, stencil).map, out));
    }
  }
}

TEST(MinConvolution, outputMayBeTheInput) {
  RandomInputs random(6);
  for (const cv::Size& size : {cv::Size(13, 7), cv::Size(5, 3)}) {
    cv::Mat1f map = random.costs(size);
    const EdgeStencil stencil = random.stencil(9, 3);
    const cv::Mat1d expected = brute_force::minConvolve(map, stencil).map;
    MinConvolution convolution;
    convolution.setStencil(stencil, size);
    convolution.run(map, cv::Mat1f(size, 0.0F), map);
    EXPECT_EQ("", firstDifference(expected, map));
  }
}

}  // namespace
}  // namespace chain_tracker
