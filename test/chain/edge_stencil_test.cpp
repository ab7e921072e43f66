// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/edge_stencil.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "chain_tracker/image/pixel_geometry.h"
#include "support/brute_force.h"
#include "support/random_inputs.h"

namespace chain_tracker {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string textOf(const EdgePotential& spring, int step) {
  std::ostringstream text;
  text << "length " << spring.length << " +- " << spring.length_sigma << " px, direction "
       << spring.direction << " +- " << spring.direction_sigma << " rad, step " << step;
  return text.str();
}

std::string textOf(const cv::Point& offset) {
  return "offset " + std::to_string(offset.x) + ", " + std::to_string(offset.y);
}

EdgeStencil sampled(const EdgePotential& spring, int step) {
  EdgeStencil stencil = {{1, 2, 3.0F}};  // of another spring
  sampleEdge(spring, step, {}, stencil);
  return stencil;
}

EdgeStencil between(const EdgeStencil& stencil, const cv::Point& origin, const cv::Size& reach) {
  EdgeStencil shifted = {{1, 2, 3.0F}};  // of other states
  betweenStates(stencil, origin, reach, shifted);
  return shifted;
}

/// Every offset of a lattice larger than any spring here, one at a time: those within three
/// standard deviations must be there once, at their cost, and no other.
void expectAllWithinCutOff(const EdgePotential& spring, int step) {
  SCOPED_TRACE(textOf(spring, step));
  const EdgeStencil stencil = sampled(spring, step);
  const double farthest = spring.length + 3.0 * spring.length_sigma;
  const int reach = static_cast<int>(farthest / step) + 3;
  size_t wanted = 0;
  for (int rows = -reach; rows <= reach; ++rows) {
    for (int columns = -reach; columns <= reach; ++columns) {
      const double cost = brute_force::springCost(spring, cv::Point2d(columns * step, rows * step));
      const double sampled = brute_force::stencilCost(stencil, {columns, rows});
      if (std::isfinite(cost)) ++wanted;
      if (std::isfinite(cost) != std::isfinite(sampled)) {
        ADD_FAILURE() << textOf(cv::Point(columns, rows)) << " costs " << sampled << ", not "
                      << cost;
      } else if (std::isfinite(cost)) {
        EXPECT_NEAR(cost, sampled, 1e-6 * (1.0 + cost)) << textOf(cv::Point(columns, rows));
      }
    }
  }
  ASSERT_GT(wanted, 0U) << "this spring tests nothing";
  EXPECT_EQ(wanted, stencil.size()) << "some offsets are there twice";
}

TEST(EdgePotential, isZeroAtRestAndHalfASquareADeviationAway) {
  const EdgePotential spring{20.0, 0.5, 2.0, 0.1};
  const auto edge = [](double length, double direction) {
    return cv::Point2d(length * std::cos(direction), length * std::sin(direction));
  };
  EXPECT_NEAR(0.0, spring.at(edge(20.0, 0.5)), 1e-12);
  EXPECT_NEAR(0.5, spring.at(edge(22.0, 0.5)), 1e-12);
  EXPECT_NEAR(2.0, spring.at(edge(16.0, 0.5)), 1e-12);
  EXPECT_NEAR(0.5, spring.at(edge(20.0, 0.6)), 1e-12);
  EXPECT_NEAR(4.5, spring.at(edge(20.0, 0.2)), 1e-12);
  EXPECT_NEAR(2.5, spring.at(edge(18.0, 0.3)), 1e-12);
}

TEST(EdgePotential, directionsMeetBehindThePoint) {
  const EdgePotential spring{10.0, CV_PI - 0.05, 1.0, 0.1};
  EXPECT_NEAR(0.5, spring.at({-10.0 * std::cos(0.05), -10.0 * std::sin(0.05)}), 1e-9);
}

TEST(OnLattice, addsTheVarianceOfRoundingBothEnds) {
  const EdgePotential spring = onLattice({30.0, 1.0, 2.0, 0.1}, 6.0);
  EXPECT_EQ(30.0, spring.length);
  EXPECT_EQ(1.0, spring.direction);
  EXPECT_NEAR(std::sqrt(4.0 + 6.0), spring.length_sigma, 1e-12);
  EXPECT_NEAR(std::sqrt(0.01 + 6.0 / 900.0), spring.direction_sigma, 1e-12);
}

TEST(SampleEdge, holdsAllOffsetsWithinThreeDeviationsAndNoOther) {
  RandomInputs random(1);
  for (int repeat = 0; repeat < 60; ++repeat) {
    const double length = random.real(6.0, 40.0);
    const EdgePotential spring{length, random.real(-CV_PI, CV_PI), random.real(0.03, 0.3) * length,
                               random.real(0.05, 0.5)};
    expectAllWithinCutOff(onLattice(spring, 1.0), 1);
    const int step = random.integer(2, 5);
    expectAllWithinCutOff(onLattice(spring, step), step);
  }
}

TEST(SampleEdge, holdsAllOffsetsOfASpringThatMayTurnAllTheWayRound) {
  for (double direction : {-3.0, -1.0, 0.0, 0.7, CV_PI}) {
    expectAllWithinCutOff({12.0, direction, 1.0, 1.2}, 1);
    expectAllWithinCutOff({12.0, direction, 1.0, 0.9}, 1);
    expectAllWithinCutOff({12.0, direction, 6.0, 3.0}, 2);
  }
}

TEST(SampleEdge, holdsAllOffsetsOfSpringsAlongTheAxes) {
  for (int quarter = -2; quarter <= 2; ++quarter) {
    for (double turn : {-0.01, 0.0, 0.01}) {
      const double direction = wrapAngle(quarter * CV_PI / 2.0 + turn);
      expectAllWithinCutOff({15.3, direction, 1.1, 0.15}, 1);
      expectAllWithinCutOff({15.3, direction, 3.0, 0.3}, 4);
    }
  }
}

TEST(SampleEdge, offsetsExactlyThreeDeviationsAwayBelong) {
  // The length and three deviations are whole numbers: nothing is rounded at the cut-off.
  for (double turn_sigma : {0.05, 0.1, 0.13, 0.2, 0.3, 0.45, 0.7, 1.5}) {
    SCOPED_TRACE(turn_sigma);
    const EdgeStencil stencil = sampled({10.0, 0.0, 1.0, turn_sigma}, 1);
    EXPECT_NEAR(4.5, brute_force::stencilCost(stencil, {13, 0}), 1e-6);
    EXPECT_NEAR(4.5, brute_force::stencilCost(stencil, {7, 0}), 1e-6);
    EXPECT_EQ(kInfinity, brute_force::stencilCost(stencil, {14, 0}));
    EXPECT_EQ(kInfinity, brute_force::stencilCost(stencil, {6, 0}));
  }
}

TEST(SampleEdge, springWidenedForItsLatticeHoldsTheOffsetNearestToRest) {
  RandomInputs random(3);
  for (int repeat = 0; repeat < 300; ++repeat) {
    const int step = random.integer(1, 8);
    const EdgePotential stiff{random.real(1.0, 6.0) * step, random.real(-CV_PI, CV_PI), 0.01,
                              0.005};
    SCOPED_TRACE(textOf(stiff, step));
    const cv::Point2d rest(stiff.length * std::cos(stiff.direction),
                           stiff.length * std::sin(stiff.direction));
    const EdgeStencil stencil = sampled(onLattice(stiff, step), step);
    ASSERT_TRUE(std::isfinite(brute_force::stencilCost(stencil, cv::Point(rest / step))));
  }
}

TEST(SampleEdge, springBetweenLatticePointsKeepsTheCheapestOne) {
  RandomInputs random(2);
  for (int repeat = 0; repeat < 100; ++repeat) {
    const int step = random.integer(1, 8);
    const EdgePotential spring{random.real(2.0, 30.0), random.real(-CV_PI, CV_PI), 0.002, 0.001};
    SCOPED_TRACE(textOf(spring, step));
    const EdgeStencil stencil = sampled(spring, step);
    ASSERT_EQ(1U, stencil.size());
    double least = kInfinity;
    for (int rows = -32; rows <= 32; ++rows) {
      for (int columns = -32; columns <= 32; ++columns) {
        least = std::min(least, spring.at(cv::Point2d(columns * step, rows * step)));
      }
    }
    ASSERT_NEAR(least, stencil[0].cost, 1e-5 * least);
  }
}

TEST(BetweenStates, countsOffsetsFromTheSecondPartsFirstState) {
  const EdgeStencil stencil = {{5, -2, 0.5F}, {6, -2, 0.25F}, {5, 0, 1.0F}};
  const EdgeStencil shifted = between(stencil, {4, -1}, {3, 3});
  ASSERT_EQ(3U, shifted.size());
  EXPECT_EQ(0.5, brute_force::stencilCost(shifted, {1, -1}));
  EXPECT_EQ(0.25, brute_force::stencilCost(shifted, {2, -1}));
  EXPECT_EQ(1.0, brute_force::stencilCost(shifted, {1, 1}));
}

TEST(BetweenStates, leavesOutOffsetsThatJoinNoTwoStates) {
  EdgeStencil stencil;
  for (int rows = -5; rows <= 5; ++rows) {
    for (int columns = -5; columns <= 5; ++columns) stencil.push_back({columns, rows, 1.0F});
  }
  const EdgeStencil shifted = between(stencil, {0, 0}, {2, 3});
  EXPECT_EQ(5U * 7U, shifted.size());
  for (const StencilOffset& offset : shifted) {
    EXPECT_LE(std::abs(offset.columns), 2);
    EXPECT_LE(std::abs(offset.rows), 3);
  }
  EXPECT_TRUE(between(stencil, {100, 0}, {2, 3}).empty());
}

TEST(Reverse, sendsTheMessageTheOtherWay) {
  RandomInputs random(7);
  const EdgeStencil stencil = random.stencil(10, 4);
  EdgeStencil backwards = stencil;
  reverse(backwards);
  ASSERT_EQ(stencil.size(), backwards.size());
  for (size_t i = 0; i < stencil.size(); ++i) {
    EXPECT_EQ(-stencil[i].columns, backwards[i].columns);
    EXPECT_EQ(-stencil[i].rows, backwards[i].rows);
    EXPECT_EQ(stencil[i].cost, backwards[i].cost);
  }
}

}  // namespace
}  // namespace chain_tracker
