// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/chain_matcher.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "workers.h"

namespace chain_tracker {
namespace {

/// A spring asks several states for each, which takes so much longer than workersFor() means.
constexpr double kStepsPerState = 8.0;

/// sum = map + cost
void raise(const cv::Mat1f& map, float cost, cv::Mat1f& sum) {
  sum.create(map.size());
  for (int row = 0; row < map.rows; ++row) {
    std::transform(map[row], map[row] + map.cols, sum[row], [=](float a) { return a + cost; });
  }
}

/// least(q) = min(least(q), other(q) + cost)
void lower(cv::Mat1f& least, const cv::Mat1f& other, float cost) {
  for (int row = 0; row < least.rows; ++row) {
    std::transform(least[row], least[row] + least.cols, other[row], least[row],
                   [=](float a, float b) { return std::min(a, b + cost); });
  }
}

double leastOf(const cv::Mat1f& map) {
  double least = 0.0;
  cv::minMaxIdx(map, &least);
  return least;
}

class Matcher {
 public:
  Matcher(const MatchingProblem& problem, ChainMatcherWorkspace& workspace)
      : problem_(problem), workspace_(workspace) {
    for (PoseMaps* maps : {&workspace.ahead, &workspace.behind, &workspace.into, &workspace.from}) {
      maps->resize(segments());
    }
    workspace.passes.resize(static_cast<size_t>(workspace.threads));
    for (PassWorkspace& pass : workspace.passes) {
      pass.solvers.resize(segments());
      pass.best_energy = std::numeric_limits<double>::infinity();
    }
    workspace.match.segments.resize(segments());
    for (size_t m = 0; m < segments(); ++m) {
      workspace.ahead[m].resize(poses(m));
      workspace.behind[m].resize(poses(m));
    }
  }

  const ChainMatch& match() {
    sweepForward();
    sweepBackward();
    ChainMatch& match = workspace_.match;
    for (size_t m = 0; m < segments(); ++m) {
      match.segments[m].pose = 0;
      match.segments[m].states.clear();
      computeEnergies(m, match.segments[m].energies);
    }
    cv::minMaxIdx(match.segments.back().energies, &match.energy);
    if (std::isfinite(match.energy)) traceChain(match);
    return match;
  }

 private:
  size_t segments() const { return problem_.segments.size(); }
  size_t poses(size_t m) const { return problem_.poses[m].size(); }
  SegmentPose pose(size_t m, size_t h) const { return problem_.poses[m].at(h); }

  /// Calls pass(workspace, pose) for all poses of a segment, which have nothing to do with one
  /// another.
  template <typename Pass>
  void forPoses(size_t m, const Pass& pass) {
    const std::vector<cv::Mat1f>& costs = problem_.candidates[m].costs;
    const double states = static_cast<double>(costs.size() * costs.front().total());
    shareOut(workspace_.threads, poses(m), kStepsPerState * states,
             [&](size_t h, size_t worker) { pass(workspace_.passes[worker], h); });
  }

  /// Sampled anew in every pass: those of all poses together would leave the caches.
  const ChainEdges& sampleEdges(size_t m, size_t h, PassWorkspace& pass) const {
    pass.sampler.sample(problem_.segments[m], problem_.candidates[m], pose(m, h), pass.edges);
    return pass.edges;
  }

  float temporal(size_t m, size_t h) const {
    return static_cast<float>(
        temporalCost(problem_.model.segments[m], problem_.previous[m], pose(m, h)));
  }

  JointModel joint(size_t m) const { return jointOf(problem_.model, m); }
  const JointRest& rest(size_t m) const { return problem_.rests[m]; }

  /// Cost of pose g of segment m with pose h of the next one.
  float jointBetween(size_t m, size_t g, size_t h) const {
    return static_cast<float>(jointCost(joint(m), pose(m, g), pose(m + 1, h)) +
                              restCost(rest(m), pose(m, g), pose(m + 1, h)));
  }

  /// ahead[m][h]: least cost of segments 0..m that end in each state under pose h.
  void sweepForward() {
    for (size_t m = 0; m < segments(); ++m) {
      if (m > 0) mergeForward(m);
      forPoses(m, [&](PassWorkspace& pass, size_t h) {
        passForward(m, h, pass);
        raise(pass.solvers[m].forward.back(), temporal(m, h), workspace_.ahead[m][h]);
        if (m + 1 == segments()) keepIfBest(h, leastOf(workspace_.ahead[m][h]), pass);
      });
    }
  }

  /// Of the last segment's passes, so that tracing need not repeat it.
  static void keepIfBest(size_t pose, double energy, PassWorkspace& pass) {
    if (energy >= pass.best_energy) return;
    pass.best_pose = pose;
    pass.best_energy = energy;
    std::swap(pass.edges, pass.best_edges);
    std::swap(pass.solvers.back().forward, pass.best_forward);
  }

  /// The one that has it; the first pose of several, as if one had passed under all.
  PassWorkspace& bestPass() {
    const auto is_better = [](const PassWorkspace& a, const PassWorkspace& b) {
      return std::make_pair(a.best_energy, a.best_pose) <
             std::make_pair(b.best_energy, b.best_pose);
    };
    return *std::min_element(workspace_.passes.begin(), workspace_.passes.end(), is_better);
  }

  /// The first node of the segment takes what the segments before say.
  void passForward(size_t m, size_t h, PassWorkspace& pass) const {
    pass.costs = problem_.candidates[m].costs;
    if (m > 0) pass.costs.front() = messageTo(h, workspace_.into[m]);
    forwardPass(pass.costs, sampleEdges(m, h, pass), pass.solvers[m]);
  }

  /// The same from the other end.
  void passBackward(size_t m, size_t h, PassWorkspace& pass) const {
    pass.costs = problem_.candidates[m].costs;
    std::reverse(pass.costs.begin(), pass.costs.end());
    if (m + 1 < segments()) pass.costs.front() = messageTo(h, workspace_.from[m]);
    pass.backward_edges.assignReversed(sampleEdges(m, h, pass));
    forwardPass(pass.costs, pass.backward_edges, pass.solvers[m]);
  }

  /// The message to each pose of segment m from the one before: the least over that one's poses.
  void mergeForward(size_t m) {
    const auto cost = [&](size_t from, size_t to) { return jointBetween(m - 1, from, to); };
    merge(workspace_.ahead[m - 1], receivers(m, m - 1), cost, workspace_.into[m]);
  }

  void mergeBackward(size_t m) {
    const auto cost = [&](size_t from, size_t to) { return jointBetween(m, to, from); };
    merge(workspace_.behind[m + 1], receivers(m, m), cost, workspace_.from[m]);
  }

  /// Poses of segment m that are told apart: a joint that costs nothing at any angle sends the same
  /// message to all.
  size_t receivers(size_t m, size_t from_joint) const {
    return isFree(joint(from_joint)) && rest(from_joint).sigma <= 0.0 ? 1 : poses(m);
  }

  static const cv::Mat1f& messageTo(size_t pose, const std::vector<cv::Mat1f>& messages) {
    return messages[std::min(pose, messages.size() - 1)];
  }

  template <typename Cost>
  static void merge(const std::vector<cv::Mat1f>& maps, size_t receivers, const Cost& cost,
                    std::vector<cv::Mat1f>& messages) {
    messages.resize(receivers);
    for (size_t to = 0; to < receivers; ++to) {
      raise(maps.front(), cost(0, to), messages[to]);
      for (size_t from = 1; from < maps.size(); ++from) {
        lower(messages[to], maps[from], cost(from, to));
      }
    }
  }

  /// behind[m][h]: least cost of segments m.. that begin in each state under pose h.
  void sweepBackward() {
    for (size_t m = segments() - 1; m > 0; --m) {
      forPoses(m, [&](PassWorkspace& pass, size_t h) {
        passBackward(m, h, pass);
        raise(pass.solvers[m].forward.back(), temporal(m, h), workspace_.behind[m][h]);
      });
      mergeBackward(m - 1);
    }
  }

  void computeEnergies(size_t m, cv::Mat1d& energies) {
    const PoseGrid& grid = problem_.poses[m];
    energies.create(grid.orientations, grid.scales);
    energies.setTo(std::numeric_limits<double>::infinity());
    for (size_t h = 0; h < poses(m); ++h) energies(grid.cellOf(h)) = energyOf(m, h);
  }

  double energyOf(size_t m, size_t h) {
    if (m + 1 == segments()) return leastOf(workspace_.ahead[m][h]);
    cv::add(workspace_.ahead[m][h], messageTo(h, workspace_.from[m]), workspace_.sum);
    return leastOf(workspace_.sum);
  }

  /// From the last segment to the first: the pose that leads to where the next one begins.
  void traceChain(ChainMatch& match) {
    const size_t last = segments() - 1;
    PassWorkspace& pass = bestPass();
    ChainSolverWorkspace& solver = pass.solvers[last];
    match.segments[last].pose = pass.best_pose;
    std::swap(solver.forward, pass.best_forward);
    traceBack(pass.best_edges, cheapestState(solver.forward.back()), solver,
              match.segments[last].states);
    for (size_t m = last; m-- > 0;) {
      SegmentMatch& segment = match.segments[m];
      const SegmentMatch& next = match.segments[m + 1];
      segment.pose = bestInto(m, next);
      passForward(m, segment.pose, pass);
      traceBack(pass.edges, next.states.front(), pass.solvers[m], segment.states);
    }
  }

  size_t bestInto(size_t m, const SegmentMatch& next) const {
    size_t best = 0;
    float least = std::numeric_limits<float>::infinity();
    for (size_t h = 0; h < poses(m); ++h) {
      const float cost =
          workspace_.ahead[m][h](next.states.front()) + jointBetween(m, h, next.pose);
      if (cost >= least) continue;
      least = cost;
      best = h;
    }
    return best;
  }

  const MatchingProblem& problem_;
  ChainMatcherWorkspace& workspace_;
};

}  // namespace

const ChainMatch& matchChain(const MatchingProblem& problem, ChainMatcherWorkspace& workspace) {
  return Matcher(problem, workspace).match();
}

}  // namespace chain_tracker
