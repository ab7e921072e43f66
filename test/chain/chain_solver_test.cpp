// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/chain_solver.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "support/brute_force.h"
#include "support/map_difference.h"
#include "support/random_inputs.h"

namespace chain_tracker {
namespace {

std::vector<cv::Point> tracedBack(const ChainEdges& edges, const cv::Point& end,
                                  const ChainSolverWorkspace& workspace) {
  std::vector<cv::Point> states;
  traceBack(edges, end, workspace, states);
  return states;
}

constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Problem {
  std::vector<cv::Mat1f> unary;
  std::vector<EdgeStencil> edges;
};

Problem randomProblem(RandomInputs& random, size_t parts, const cv::Size& states,
                      double forbidden) {
  Problem problem{random.costMaps(parts, states, forbidden), {}};
  for (size_t k = 1; k < parts; ++k) problem.edges.push_back(random.stencil(4, 2));
  return problem;
}

struct ProblemSize {
  size_t parts;
  cv::Size states;
  long long chains;
};

/// Few enough chains to look at all of them.
std::vector<ProblemSize> problemSizes() {
  return {{1, {1, 1}, 1},    {1, {5, 4}, 20},   {2, {1, 1}, 1},   {2, {7, 1}, 49},
          {2, {1, 7}, 49},   {3, {3, 3}, 729},  {3, {4, 2}, 512}, {4, {2, 3}, 1296},
          {5, {2, 2}, 1024}, {3, {5, 3}, 3375}, {6, {3, 1}, 729}};
}

std::string textOf(const ProblemSize& size) {
  return std::to_string(size.parts) + " parts on " + std::to_string(size.states.width) + "x" +
         std::to_string(size.states.height) + " states";
}

TEST(ChainSolver, slowTwinLooksAtEveryChain) {
  RandomInputs random(1);
  for (const ProblemSize& size : problemSizes()) {
    SCOPED_TRACE(textOf(size));
    const Problem problem = randomProblem(random, size.parts, size.states, 0.0);
    const auto edge = brute_force::edgeCostOf(problem.edges);
    EXPECT_EQ(size.chains, brute_force::enumerateChains(problem.unary, edge).chains);
  }
}

TEST(ChainSolver, findsTheBestOfAllChains) {
  RandomInputs random(2);
  int feasible = 0;
  int infeasible = 0;
  for (const ProblemSize& size : problemSizes()) {
    for (int repeat = 0; repeat < 12; ++repeat) {
      SCOPED_TRACE(textOf(size) + ", repeat " + std::to_string(repeat));
      const Problem problem = randomProblem(random, size.parts, size.states, 0.05 * repeat);
      const auto edge = brute_force::edgeCostOf(problem.edges);
      const double best = brute_force::enumerateChains(problem.unary, edge).cost;
      ChainSolverWorkspace workspace;
      const double cost = forwardPass(problem.unary, problem.edges, workspace);
      EXPECT_EQ(best, cost);
      if (!std::isfinite(best)) {
        ++infeasible;
        continue;
      }
      ++feasible;
      const std::vector<cv::Point> states =
          tracedBack(problem.edges, cheapestState(workspace.forward.back()), workspace);
      ASSERT_EQ(size.parts, states.size());
      EXPECT_EQ(cost, brute_force::energyOf(problem.unary, edge, states));
    }
  }
  EXPECT_GT(feasible, 50);
  EXPECT_GT(infeasible, 10);
}

TEST(ChainSolver, minMarginalsAreTheBestChainsThroughEachState) {
  RandomInputs random(3);
  for (const ProblemSize& size : problemSizes()) {
    for (int repeat = 0; repeat < 6; ++repeat) {
      SCOPED_TRACE(textOf(size) + ", repeat " + std::to_string(repeat));
      const Problem problem = randomProblem(random, size.parts, size.states, 0.08 * repeat);
      const auto all =
          brute_force::enumerateChains(problem.unary, brute_force::edgeCostOf(problem.edges));
      ChainSolverWorkspace workspace;
      forwardPass(problem.unary, problem.edges, workspace);
      std::vector<cv::Mat1f> marginals;
      minMarginals(problem.unary, problem.edges, marginals, workspace);
      ASSERT_EQ(size.parts, marginals.size());
      for (size_t k = 0; k < marginals.size(); ++k) {
        EXPECT_EQ("", firstDifference(all.marginals[k], marginals[k])) << "part " << k;
      }
    }
  }
}

TEST(ChainSolver, everyMinMarginalsLeastCostIsTheChains) {
  RandomInputs random(4);
  const Problem problem = randomProblem(random, 12, {15, 11}, 0.2);
  ChainSolverWorkspace workspace;
  const double cost = forwardPass(problem.unary, problem.edges, workspace);
  ASSERT_TRUE(std::isfinite(cost));
  const std::vector<cv::Point> states =
      tracedBack(problem.edges, cheapestState(workspace.forward.back()), workspace);
  std::vector<cv::Mat1f> marginals;
  minMarginals(problem.unary, problem.edges, marginals, workspace);
  for (size_t k = 0; k < marginals.size(); ++k) {
    double least = 0.0;
    cv::minMaxLoc(marginals[k], &least);
    EXPECT_EQ(cost, least) << "part " << k;
    EXPECT_EQ(cost, marginals[k](states[k])) << "part " << k;
  }
}

TEST(ChainSolver, forbiddenPartMakesTheChainInfeasible) {
  RandomInputs random(5);
  for (size_t k = 0; k < 4; ++k) {
    SCOPED_TRACE("part " + std::to_string(k));
    Problem problem = randomProblem(random, 4, {6, 6}, 0.0);
    problem.unary[k].setTo(kInfinity);
    ChainSolverWorkspace workspace;
    EXPECT_EQ(kInfinity, forwardPass(problem.unary, problem.edges, workspace));
  }
}

TEST(ChainSolver, edgeThatReachesNothingMakesTheChainInfeasible) {
  RandomInputs random(6);
  Problem problem = randomProblem(random, 3, {4, 4}, 0.0);
  ChainSolverWorkspace workspace;
  problem.edges[1] = {{4, 0, 0.0F}};
  EXPECT_EQ(kInfinity, forwardPass(problem.unary, problem.edges, workspace));
  problem.edges[1] = {};
  EXPECT_EQ(kInfinity, forwardPass(problem.unary, problem.edges, workspace));
}

/// Two parts that match well at one spot each and badly elsewhere, with a spring between them whose
/// rest offset is `rest` columns and whose cost is the square of what it is stretched.
struct TwoSpots {
  static constexpr float kElsewhere = 30.0F;
  Problem problem;

  explicit TwoSpots(int rest) {
    problem.unary.assign(2, cv::Mat1f());
    for (cv::Mat1f& map : problem.unary) map = cv::Mat1f(20, 40, kElsewhere);
    problem.unary[0](10, 10) = 0.0F;
    problem.unary[1](14, 13) = 0.0F;
    problem.edges.emplace_back();
    for (int rows = -9; rows <= 9; ++rows) {
      for (int columns = -9; columns <= 9; ++columns) {
        const auto cost =
            static_cast<float>((columns - rest) * (columns - rest) + (rows - 4) * (rows - 4));
        problem.edges[0].push_back({columns, rows, cost});
      }
    }
  }
};

TEST(ChainSolver, springAtRestJoinsBothSpotsForNothing) {
  const TwoSpots spots(3);
  ChainSolverWorkspace workspace;
  EXPECT_EQ(0.0, forwardPass(spots.problem.unary, spots.problem.edges, workspace));
  const std::vector<cv::Point> states =
      tracedBack(spots.problem.edges, cheapestState(workspace.forward.back()), workspace);
  EXPECT_EQ(cv::Point(10, 10), states[0]);
  EXPECT_EQ(cv::Point(13, 14), states[1]);
}

/// A spring stretched by x costs x^2; leaving one spot costs 30. So the spots are joined up to a
/// stretch of 5 (25 < 30), and left at 6 (36 > 30).
TEST(ChainSolver, spotIsLeftOnceStretchingCostsMore) {
  ChainSolverWorkspace workspace;
  const TwoSpots stretched(3 - 5);
  EXPECT_EQ(25.0, forwardPass(stretched.problem.unary, stretched.problem.edges, workspace));
  EXPECT_EQ(cv::Point(10, 10), tracedBack(stretched.problem.edges,
                                          cheapestState(workspace.forward.back()), workspace)[0]);
  EXPECT_EQ(cv::Point(13, 14), tracedBack(stretched.problem.edges,
                                          cheapestState(workspace.forward.back()), workspace)[1]);

  const TwoSpots torn(3 - 6);
  EXPECT_EQ(30.0, forwardPass(torn.problem.unary, torn.problem.edges, workspace));
  // Two chains cost 30; the one whose last part comes first in row-major order is taken.
  EXPECT_EQ(cv::Point(10, 10),
            tracedBack(torn.problem.edges, cheapestState(workspace.forward.back()), workspace)[0]);
  EXPECT_EQ(cv::Point(7, 14),
            tracedBack(torn.problem.edges, cheapestState(workspace.forward.back()), workspace)[1]);
}

ChainEdges twoAlike(const EdgeStencil& stencil) {
  ChainEdges edges;
  edges.addKind() = stencil;
  edges.addEdge(0);
  edges.addEdge(0);
  return edges;
}

TEST(ChainSolver, chainOfThreeShiftsAsAWhole) {
  std::vector<cv::Mat1f> unary(3, cv::Mat1f());
  for (cv::Mat1f& map : unary) map = cv::Mat1f(1, 30, 9.0F);
  unary[0](0, 12) = unary[1](0, 16) = unary[2](0, 22) = 0.0F;
  // Springs at rest at 5 columns, of cost (stretch)^2: both are stretched by one.
  const ChainEdges edges = twoAlike({{4, 0, 1.0F}, {5, 0, 0.0F}, {6, 0, 1.0F}});
  ChainSolverWorkspace workspace;
  EXPECT_EQ(2.0, forwardPass(unary, edges, workspace));
  const std::vector<cv::Point> states =
      tracedBack(edges, cheapestState(workspace.forward.back()), workspace);
  EXPECT_EQ((std::vector<cv::Point>{{12, 0}, {16, 0}, {22, 0}}), states);
}

TEST(ChainSolver, tiesGoToTheFirstStateOfTheLastPartThenToTheFirstOffset) {
  const std::vector<cv::Mat1f> unary(3, cv::Mat1f(4, 5, 1.0F));
  const ChainEdges edges = twoAlike({{-1, 0, 0.5F}, {0, -2, 0.5F}, {1, 0, 0.5F}});
  ChainSolverWorkspace workspace;
  EXPECT_EQ(4.0, forwardPass(unary, edges, workspace));
  const std::vector<cv::Point> states =
      tracedBack(edges, cheapestState(workspace.forward.back()), workspace);
  EXPECT_EQ((std::vector<cv::Point>{{2, 0}, {1, 0}, {0, 0}}), states);
}

TEST(ChainSolver, workspaceOfALongerChainLeavesNoTrace) {
  RandomInputs random(8);
  ChainSolverWorkspace workspace;
  for (const ProblemSize& size : {ProblemSize{5, {2, 2}, 0}, {2, {7, 1}, 0}, {3, {3, 3}, 0}}) {
    SCOPED_TRACE(textOf(size));
    const Problem problem = randomProblem(random, size.parts, size.states, 0.0);
    const auto all =
        brute_force::enumerateChains(problem.unary, brute_force::edgeCostOf(problem.edges));
    EXPECT_EQ(all.cost, forwardPass(problem.unary, problem.edges, workspace));
    std::vector<cv::Mat1f> marginals(9);
    minMarginals(problem.unary, problem.edges, marginals, workspace);
    ASSERT_EQ(size.parts, marginals.size());
    EXPECT_EQ("", firstDifference(all.marginals.front(), marginals.front()));
  }
}

}  // namespace
}  // namespace chain_tracker
