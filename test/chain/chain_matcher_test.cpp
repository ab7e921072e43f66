// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/chain_matcher.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "chain_tracker/image/pixel_geometry.h"
#include "support/brute_force.h"
#include "support/lattice_candidates.h"
#include "support/map_difference.h"
#include "support/random_inputs.h"
#include "support/spring_chain.h"

namespace chain_tracker {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double temporalCostByHand(const SegmentModel& model, const SegmentPose& previous,
                          const SegmentPose& pose) {
  double turn = pose.orientation - previous.orientation;
  while (turn > CV_PI) turn -= 2.0 * CV_PI;
  while (turn < -CV_PI) turn += 2.0 * CV_PI;
  const double turn_sigmas = turn / model.orientation_sigma;
  const double growth_sigmas =
      (std::log(pose.scale) - std::log(previous.scale)) / model.scale_sigma;
  return 0.5 * (turn_sigmas * turn_sigmas + growth_sigmas * growth_sigmas);
}

double restCostByHand(const JointRest& rest, const SegmentPose& before, const SegmentPose& behind) {
  if (rest.sigma == 0.0) return 0.0;
  double bend = behind.orientation - before.orientation - rest.angle;
  while (bend > CV_PI) bend -= 2.0 * CV_PI;
  while (bend < -CV_PI) bend += 2.0 * CV_PI;
  return std::min(20.0, 0.5 * bend * bend / (rest.sigma * rest.sigma));
}

/// Several segments end to end, few states and poses, somewhere, with random costs.
struct TinyChain {
  std::vector<SegmentLayout> segments;
  ChainModel model;
  std::vector<SegmentPose> previous;
  std::vector<JointRest> rests;
  std::vector<PoseGrid> poses;
  std::vector<SegmentCandidates> candidates;

  MatchingProblem problem() const { return {segments, model, previous, rests, poses, candidates}; }

  /// All node maps in order; a joint is one node.
  std::vector<cv::Mat1f> nodeCosts() const {
    std::vector<cv::Mat1f> costs;
    for (size_t m = 0; m < segments.size(); ++m) {
      for (size_t k = m > 0 ? 1 : 0; k < candidates[m].costs.size(); ++k) {
        costs.push_back(candidates[m].costs[k]);
      }
    }
    return costs;
  }

  /// Springs between all nodes, with each segment in one pose.
  brute_force::EdgeCost springs(const std::vector<SegmentPose>& chosen) const {
    std::vector<brute_force::EdgeCost> springs;
    for (size_t m = 0; m < segments.size(); ++m) {
      const auto own = springsOf(segments[m], chosen[m], candidates[m]);
      for (size_t k = 0; k < segments[m].edges.size(); ++k) {
        springs.push_back([own, k](size_t, const cv::Point& from, const cv::Point& to) {
          return own(k, from, to);
        });
      }
    }
    return [springs](size_t k, const cv::Point& from, const cv::Point& to) {
      return springs[k](k, from, to);
    };
  }

  double poseCosts(const std::vector<SegmentPose>& chosen) const {
    double cost = 0.0;
    for (size_t m = 0; m < segments.size(); ++m) {
      cost += temporalCostByHand(model.segments[m], previous[m], chosen[m]);
      if (m > 0 && !model.joints.empty()) {
        cost += jointCost(model.joints[m - 1], chosen[m - 1], chosen[m]);
      }
      if (m > 0) cost += restCostByHand(rests[m - 1], chosen[m - 1], chosen[m]);
    }
    return cost;
  }
};

struct TinySize {
  std::vector<size_t> edges;  ///< of each segment
  int orientations;
  int scales;
  int reach;
};

TinyChain tinyChain(RandomInputs& random, const TinySize& size, bool limited) {
  TinyChain chain;
  chain.model.segments.resize(size.edges.size());
  const int step = random.integer(1, 3);
  cv::Point2d start(50.0, 50.0);
  for (size_t m = 0; m < size.edges.size(); ++m) {
    std::vector<EdgeLayout> edges;
    for (size_t k = 0; k < size.edges[m]; ++k) {
      edges.push_back({random.real(6.0, 15.0), random.real(-CV_PI, CV_PI), random.real(0.03, 0.2),
                       random.real(0.05, 0.3)});
    }
    chain.segments.push_back(chainOf(edges));
    chain.previous.push_back({random.real(-CV_PI, CV_PI), random.real(0.7, 1.5)});
    chain.model.segments[m].orientation_sigma = random.real(0.1, 0.5);
    chain.model.segments[m].scale_sigma = random.real(0.05, 0.3);
    chain.poses.push_back({chain.previous[m], size.orientations, 0.15, size.scales, 0.1});
    const Similarity transform{chain.previous[m].orientation + random.real(-0.3, 0.3),
                               chain.previous[m].scale * random.real(0.9, 1.1), start};
    const std::vector<cv::Point2d> nodes = placed(chain.segments[m], transform);
    const CandidateGrid grid = gridAround(nodes, 10.0, step, size.reach * step);
    SegmentCandidates candidates =
        candidatesOn(grid, random.costMaps(nodes.size(), grid.states, 0.1));
    // Every segment has a lattice of its own, but the joint lies on that of the segment before.
    const cv::Point2d shift = random.point(-0.5, 0.5);
    for (cv::Point2d& origin : candidates.origins) origin += shift;
    if (m > 0) {
      candidates.origins.front() = chain.candidates[m - 1].origins.back();
      chain.candidates[m - 1].costs.back().setTo(0.0F);
      candidates.costs.front().setTo(0.0F);
    }
    chain.candidates.push_back(candidates);
    start = nodes.back();
  }
  chain.rests.resize(size.edges.size() - 1);
  for (size_t m = 1; limited && m < chain.segments.size(); ++m) {
    const double angle =
        wrapAngle(chain.previous[m].orientation - chain.previous[m - 1].orientation);
    chain.model.joints.push_back({std::max(-CV_PI, angle - 0.1), std::min(CV_PI, angle + 0.05)});
  }
  return chain;
}

/// Every chain under every choice of poses. The workspace may be that of another chain.
void expectGloballyOptimal(const TinyChain& chain, ChainMatcherWorkspace& workspace) {
  const ChainMatch found = matchChain(chain.problem(), workspace);
  std::vector<cv::Mat1d> energies;
  size_t choices = 1;
  for (const PoseGrid& grid : chain.poses) {
    energies.emplace_back(grid.orientations, grid.scales, kInfinity);
    choices *= grid.size();
  }
  const std::vector<cv::Mat1f> costs = chain.nodeCosts();
  long long chains = 0;
  for (size_t choice = 0; choice < choices; ++choice) {
    std::vector<SegmentPose> poses;
    std::vector<size_t> indices;
    size_t rest = choice;
    for (const PoseGrid& grid : chain.poses) {
      indices.push_back(rest % grid.size());
      poses.push_back(grid.at(indices.back()));
      rest /= grid.size();
    }
    const auto all = brute_force::enumerateChains(costs, chain.springs(poses));
    chains += all.chains;
    for (size_t m = 0; m < energies.size(); ++m) {
      double& least = energies[m](chain.poses[m].cellOf(indices[m]));
      least = std::min(least, all.cost + chain.poseCosts(poses));
    }
  }
  const double states = chain.candidates.front().states.area();
  EXPECT_EQ(double(choices) * std::pow(states, double(costs.size())), double(chains));
  double least = 0.0;
  cv::minMaxLoc(energies.front(), &least);
  ASSERT_LT(least, kInfinity) << "this problem tests nothing";
  ASSERT_TRUE(found.found());
  EXPECT_NEAR(least, found.energy, 1e-4);
  std::vector<SegmentPose> poses;
  std::vector<cv::Point> chain_states;
  for (size_t m = 0; m < energies.size(); ++m) {
    EXPECT_EQ("", firstDifference(energies[m], found.segments[m].energies, 1e-3));
    poses.push_back(chain.poses[m].at(found.segments[m].pose));
    const std::vector<cv::Point>& own = found.segments[m].states;
    if (m > 0) {
      EXPECT_EQ(chain_states.back(), own.front()) << "the joint is torn";
    }
    chain_states.insert(chain_states.end(), own.begin() + (m > 0 ? 1 : 0), own.end());
  }
  const double energy = brute_force::energyOf(costs, chain.springs(poses), chain_states);
  EXPECT_NEAR(least, energy + chain.poseCosts(poses), 1e-4);
}

TEST(MatchChain, isGloballyOptimalForOneSegment) {
  RandomInputs random(2);
  ChainMatcherWorkspace workspace;
  for (int repeat = 0; repeat < 8; ++repeat) {
    SCOPED_TRACE("three parts, repeat " + std::to_string(repeat));
    expectGloballyOptimal(tinyChain(random, {{2}, 5, 3, 2}, false), workspace);
  }
  for (int repeat = 0; repeat < 8; ++repeat) {
    SCOPED_TRACE("four parts, repeat " + std::to_string(repeat));
    expectGloballyOptimal(tinyChain(random, {{3}, 5, 3, 1}, false), workspace);
  }
}

TEST(MatchChain, isGloballyOptimalForJoinedSegments) {
  RandomInputs random(4);
  ChainMatcherWorkspace workspace;
  for (bool limited : {false, true}) {
    for (int repeat = 0; repeat < 6; ++repeat) {
      SCOPED_TRACE("limited " + std::to_string(limited) + ", repeat " + std::to_string(repeat));
      expectGloballyOptimal(tinyChain(random, {{2, 1}, 3, 3, 1}, limited), workspace);
      expectGloballyOptimal(tinyChain(random, {{1, 1, 1}, 3, 1, 1}, limited), workspace);
      TinyChain resting = tinyChain(random, {{1, 1, 1}, 3, 1, 1}, limited);
      resting.rests.back() = {random.real(-CV_PI, CV_PI), random.real(0.1, 2.0)};
      expectGloballyOptimal(resting, workspace);
      resting.rests.front() = {random.real(-CV_PI, CV_PI), random.real(0.1, 2.0)};
      expectGloballyOptimal(resting, workspace);
    }
  }
}

/// The limit changes the answer: the two problems differ in nothing else.
TEST(MatchChain, limitsTurnJointsBack) {
  RandomInputs random(5);
  int changed = 0;
  for (int repeat = 0; repeat < 10; ++repeat) {
    TinyChain chain = tinyChain(random, {{2, 2}, 5, 1, 2}, false);
    ChainMatcherWorkspace workspace;
    const ChainMatch free = matchChain(chain.problem(), workspace);
    const double angle = wrapAngle(chain.previous[1].orientation - chain.previous[0].orientation);
    chain.model.joints = {{std::max(-CV_PI, angle - 0.01), std::min(CV_PI, angle + 0.01)}};
    const ChainMatch limited = matchChain(chain.problem(), workspace);
    EXPECT_GE(limited.energy, free.energy - 1e-4);
    const auto turn = [&](size_t m) { return static_cast<int>(limited.segments[m].pose); };
    EXPECT_EQ(turn(0), turn(1)) << "both turn alike, or the angle would leave its limits";
    changed += limited.energy > free.energy + 1e-3 ? 1 : 0;
  }
  EXPECT_GT(changed, 0);
}

/// Costs that are least where the parts would be in a pose.
std::vector<SegmentCandidates> candidatesShowing(const SegmentLayout& segment,
                                                 const SegmentPose& pose) {
  const std::vector<cv::Point2d> truth = placed(segment, {pose.orientation, pose.scale, {50, 50}});
  const CandidateGrid grid = gridAround(truth, 8.0, 1, 6.0);
  std::vector<cv::Mat1f> costs(truth.size());
  for (cv::Mat1f& map : costs) {
    map = cv::Mat1f(grid.states, 20.0F);
    map(grid.states.height / 2, grid.states.width / 2) = 0.0F;
  }
  return {candidatesOn(grid, costs)};
}

TEST(MatchChain, findsThePoseThatTheCostsShow) {
  const std::vector<SegmentLayout> segments = {
      chainOf({{40.0, 0.0, 0.01, 0.01}, {40.0, 0.5, 0.01, 0.01}})};
  ChainModel model;
  model.segments[0].orientation_sigma = model.segments[0].scale_sigma = 10.0;
  const std::vector<SegmentPose> previous = {{0.2, 1.0}};
  const std::vector<JointRest> rests;
  const std::vector<PoseGrid> poses = {{previous[0], 5, 0.1, 3, 0.05}};
  for (size_t pose = 0; pose < poses[0].size(); ++pose) {
    const auto candidates = candidatesShowing(segments[0], poses[0].at(pose));
    ChainMatcherWorkspace workspace;
    const ChainMatch match =
        matchChain({segments, model, previous, rests, poses, candidates}, workspace);
    ASSERT_TRUE(match.found());
    EXPECT_EQ(pose, match.segments[0].pose);
    for (const cv::Point& state : match.segments[0].states) {
      EXPECT_EQ(cv::Point(candidates[0].states / 2), state);
    }
  }
}

/// Costs of few different values: poses and states tie.
TEST(MatchChain, threadsChangeNothing) {
  RandomInputs random(7);
  ChainMatcherWorkspace many;
  for (int threads = 2; threads <= 5; ++threads) {
    for (const TinySize& size : {TinySize{{3}, 5, 3, 40}, TinySize{{2, 2}, 5, 1, 40}}) {
      SCOPED_TRACE(std::to_string(threads) +
                   " threads, segments: " + std::to_string(size.edges.size()));
      TinyChain chain = tinyChain(random, size, true);
      for (cv::Mat1f& costs : chain.candidates.back().costs) costs.setTo(1.0F, costs > 1.0F);
      ChainMatcherWorkspace one;
      const ChainMatch alone = matchChain(chain.problem(), one);
      many.threads = threads;
      const ChainMatch& together = matchChain(chain.problem(), many);
      ASSERT_TRUE(alone.found());
      EXPECT_EQ(alone.energy, together.energy);
      for (size_t m = 0; m < chain.segments.size(); ++m) {
        EXPECT_EQ(alone.segments[m].pose, together.segments[m].pose);
        EXPECT_EQ(alone.segments[m].states, together.segments[m].states);
        EXPECT_EQ("", firstDifference(alone.segments[m].energies, together.segments[m].energies));
      }
    }
  }
}

TEST(MatchChain, findsNothingWhereNoChainIsAllowed) {
  RandomInputs random(3);
  for (const TinySize& size : {TinySize{{2}, 5, 3, 1}, TinySize{{2, 2}, 5, 3, 1}}) {
    TinyChain chain = tinyChain(random, size, false);
    chain.candidates.back().costs[1].setTo(kInfinity);
    ChainMatcherWorkspace workspace;
    const ChainMatch match = matchChain(chain.problem(), workspace);
    EXPECT_FALSE(match.found());
    EXPECT_EQ(kInfinity, match.energy);
    for (const SegmentMatch& segment : match.segments) {
      EXPECT_EQ("", firstDifference(cv::Mat1d(5, 3, kInfinity), segment.energies));
    }
  }
}

}  // namespace
}  // namespace chain_tracker
