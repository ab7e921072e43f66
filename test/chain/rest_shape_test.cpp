// SPDX-License-Identifier: BSD-3-Clause
#include "chain/rest_shape.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "chain_tracker/image/pixel_geometry.h"
#include "support/random_inputs.h"

namespace chain_tracker {
namespace {

std::vector<double> rested(const std::vector<double>& before, const std::vector<bool>& is_hidden,
                           const std::vector<double>& turns) {
  std::vector<double> rest;
  restDirections(before, is_hidden, turns, rest);
  return rest;
}

/// The directions after so many frames in which nothing else moves the chain.
std::vector<double> settled(std::vector<double> directions, const std::vector<bool>& is_hidden,
                            const std::vector<double>& turns, int frames = 200) {
  for (int i = 0; i < frames; ++i) directions = rested(directions, is_hidden, turns);
  return directions;
}

void expectDirections(const std::vector<double>& expected, const std::vector<double>& actual) {
  ASSERT_EQ(expected.size(), actual.size());
  for (size_t k = 0; k < expected.size(); ++k) {
    EXPECT_NEAR(0.0, wrapAngle(expected[k] - actual[k]), 1e-9) << "edge " << k;
  }
}

const std::vector<double> kNoTurns(5, 0.0);

TEST(RestDirections, whatIsSeenRestsAsItWas) {
  const std::vector<double> before = {0.1, -3.0, 3.0, 1.0, 0.2};
  EXPECT_EQ(before, rested(before, std::vector<bool>(5, false), kNoTurns));
}

TEST(RestDirections, whatIsHiddenAllAlongRestsAsItWas) {
  const std::vector<double> before = {0.1, -3.0, 3.0, 1.0, 0.2};
  EXPECT_EQ(before, rested(before, std::vector<bool>(5, true), kNoTurns));
}

TEST(RestDirections, aHiddenStretchComesToTurnEvenly) {
  expectDirections({0.0, 0.2, 0.4, 0.6, 0.8},
                   settled({0.0, 2.0, -2.0, 1.0, 0.8}, {false, true, true, true, false}, kNoTurns));
}

TEST(RestDirections, hiddenEndsComeToLeadStraightOn) {
  expectDirections({0.5, 0.5, 0.5, 0.7, 0.7},
                   settled({-1.0, 2.0, 0.5, 0.7, 3.0}, {true, true, false, false, true}, kNoTurns));
}

TEST(RestDirections, theShorterWayRoundIsTaken) {
  expectDirections(
      {3.0, wrapAngle(3.0 + CV_PI - 3.0), -3.0, 0.0, 0.0},
      settled({3.0, 0.0, -3.0, 0.0, 0.0}, {false, true, false, false, false}, kNoTurns));
}

TEST(RestDirections, turnsAreTakenUp) {
  const std::vector<double> turns = {9.9, 0.1, 0.2, 0.3, 0.4};
  expectDirections({-0.3, -0.2, 0.0, 0.3, 0.7},
                   settled({1.0, 1.0, 0.0, 1.0, 1.0}, {true, true, false, true, true}, turns));
  // Between the ends the turns amount to 1, of which the hidden edges miss 0.2 each.
  expectDirections({0.0, 0.3, 0.7, 1.2, 1.8},
                   settled({0.0, 1.0, 1.0, 1.0, 1.8}, {false, true, true, true, false}, turns));
}

TEST(RestDirections, oneFrameLeavesMostOfTheShape) {
  const std::vector<double> rest =
      rested({0.0, 1.0, 0.0, 0.0, 0.0}, {false, true, false, false, false}, kNoTurns);
  EXPECT_GT(rest[1], 0.5);
  EXPECT_LT(rest[1], 1.0);
}

/// What is settled has the turns given but for a constant in every stretch between seen edges.
TEST(RestDirections, settledStretchesDifferFromTheTurnsByAConstant) {
  RandomInputs random(1);
  for (int repeat = 0; repeat < 50; ++repeat) {
    SCOPED_TRACE("repeat " + std::to_string(repeat));
    const size_t edges = 12;
    std::vector<double> before;
    std::vector<double> turns;
    std::vector<bool> is_hidden;
    for (size_t k = 0; k < edges; ++k) {
      before.push_back(random.real(-CV_PI, CV_PI));
      turns.push_back(random.real(-0.3, 0.3));
      is_hidden.push_back(k > 0 && random.real(0.0, 1.0) < 0.7);
    }
    const std::vector<double> rest = settled(before, is_hidden, turns);
    for (size_t k = 1; k < edges; ++k) {
      if (!is_hidden[k]) {
        EXPECT_EQ(before[k], rest[k]);
        continue;
      }
      if (k + 1 == edges) continue;
      const double here = wrapAngle(rest[k] - rest[k - 1] - turns[k]);
      const double next = wrapAngle(rest[k + 1] - rest[k] - turns[k + 1]);
      EXPECT_NEAR(0.0, wrapAngle(here - next), 1e-6) << "edge " << k;
    }
  }
}

}  // namespace
}  // namespace chain_tracker
