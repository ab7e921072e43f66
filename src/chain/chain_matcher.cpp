// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/chain_matcher.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "chain_tracker/image/pixel_geometry.h"

namespace chain_tracker {
namespace {

/// Lattices are taken for aligned within this [px].
constexpr double kSamePosition = 1e-6;

/// The way from one node's state (0, 0) to the next one's: whole steps, and what is left [px].
struct LatticeShift {
  cv::Point steps;
  cv::Point2d rest;
};

LatticeShift shiftBetween(const SegmentCandidates& candidates, size_t k) {
  const double step = candidates.step;
  const cv::Point2d difference = candidates.origins[k + 1] - candidates.origins[k];
  LatticeShift shift;
  shift.steps = {cvRound(difference.x / step), cvRound(difference.y / step)};
  shift.rest = difference - cv::Point2d(shift.steps) * step;
  if (cv::norm(shift.rest) < kSamePosition) shift.rest = {};
  return shift;
}

EdgeStencil sampleSpring(const EdgeLayout& edge, const SegmentPose& pose, int step,
                         const cv::Point2d& shift) {
  const double length = pose.scale * edge.length;
  const EdgePotential potential{length, pose.orientation + edge.direction,
                                edge.stretch_sigma * length, edge.bend_sigma};
  return sampleEdge(onLattice(potential, step), step, shift);
}

/// Whether a spring would be the other one if it were turned by `turn` [rad].
bool areAlike(const EdgeLayout& a, const EdgeLayout& b, double turn) {
  return std::abs(a.length - b.length) < 1e-6 &&
         std::abs(wrapAngle(a.direction + turn - b.direction)) < 1e-6 &&
         a.stretch_sigma == b.stretch_sigma && a.bend_sigma == b.bend_sigma;
}

/// Samples the springs of a segment under a pose. A grid of cells has only three different ones, of
/// which two point against each other, and sampling one costs more than its message; between
/// lattices that are as many steps apart, even the stencils are the same.
class EdgeSampler {
 public:
  EdgeSampler(const SegmentLayout& segment, const SegmentCandidates& candidates,
              const SegmentPose& pose)
      : segment_(segment), candidates_(candidates), pose_(pose) {}

  ChainEdges sample() {
    for (size_t k = 0; k < segment_.edges.size(); ++k) {
      edges_.addEdge(kindOf(k, shiftBetween(candidates_, k)));
    }
    return std::move(edges_);
  }

 private:
  struct Spring {
    size_t edge;
    cv::Point2d rest;
    EdgeStencil stencil;
    std::vector<std::pair<cv::Point, size_t>> kinds;  // by the steps between the lattices
  };

  /// The spring sampled that is alike when turned, or null.
  Spring* sampled(size_t edge, const cv::Point2d& rest, double turn) {
    for (Spring& spring : springs_) {
      const EdgeLayout& layout = segment_.edges[spring.edge];
      if (spring.rest == rest && areAlike(layout, segment_.edges[edge], turn)) return &spring;
    }
    return nullptr;
  }

  Spring& springOf(size_t edge, const cv::Point2d& rest) {
    if (Spring* const same = sampled(edge, rest, 0.0)) return *same;
    const Spring* const opposite = sampled(edge, -rest, CV_PI);
    EdgeStencil stencil = opposite
                              ? reversed(opposite->stencil)
                              : sampleSpring(segment_.edges[edge], pose_, candidates_.step, rest);
    springs_.push_back({edge, rest, std::move(stencil), {}});
    return springs_.back();
  }

  size_t kindOf(size_t edge, const LatticeShift& shift) {
    Spring& spring = springOf(edge, shift.rest);
    for (const auto& [steps, kind] : spring.kinds) {
      if (steps == shift.steps) return kind;
    }
    const cv::Size reach = candidates_.states - cv::Size(1, 1);
    const size_t kind = edges_.addKind(betweenStates(spring.stencil, shift.steps, reach));
    spring.kinds.emplace_back(shift.steps, kind);
    return kind;
  }

  const SegmentLayout& segment_;
  const SegmentCandidates& candidates_;
  SegmentPose pose_;
  std::vector<Spring> springs_;
  ChainEdges edges_;
};

/// least(q) = min(least(q), other(q))
void lower(cv::Mat1f& least, const cv::Mat1f& other) {
  std::transform(least.begin(), least.end(), other.begin(), least.begin(),
                 [](float a, float b) { return std::min(a, b); });
}

/// [segment][pose]: a map over the states of a joint, or of the last node.
using PoseMaps = std::vector<std::vector<cv::Mat1f>>;

double leastOf(const cv::Mat1f& map) {
  double least = 0.0;
  cv::minMaxIdx(map, &least);
  return least;
}

cv::Mat1f sumOf(const cv::Mat1f& a, const cv::Mat1f& b) {
  cv::Mat1f sum;
  cv::add(a, b, sum);
  return sum;
}

cv::Mat1f raised(const cv::Mat1f& map, float cost) {
  cv::Mat1f raised_map;
  cv::add(map, cost, raised_map);
  return raised_map;
}

class Matcher {
 public:
  Matcher(const MatchingProblem& problem, ChainSolverWorkspace& workspace)
      : problem_(problem), workspace_(workspace) {}

  ChainMatch match() {
    sweepForward();
    sweepBackward();
    ChainMatch match;
    for (size_t m = 0; m < segments(); ++m) match.segments.push_back({0, energiesOf(m), {}});
    cv::minMaxIdx(match.segments.back().energies, &match.energy);
    if (std::isfinite(match.energy)) traceChain(match);
    return match;
  }

 private:
  size_t segments() const { return problem_.segments.size(); }
  size_t poses(size_t m) const { return problem_.poses[m].size(); }
  SegmentPose pose(size_t m, size_t h) const { return problem_.poses[m].at(h); }

  /// Sampled anew in every pass: those of all poses together would leave the caches.
  ChainEdges edges(size_t m, size_t h) const {
    return sampleEdges(problem_.segments[m], problem_.candidates[m], pose(m, h));
  }

  float temporal(size_t m, size_t h) const {
    return static_cast<float>(
        temporalCost(problem_.model.segments[m], problem_.previous[m], pose(m, h)));
  }

  JointModel joint(size_t m) const { return jointOf(problem_.model, m); }

  /// Cost of pose g of segment m with pose h of the next one.
  float jointBetween(size_t m, size_t g, size_t h) const {
    return static_cast<float>(jointCost(joint(m), pose(m, g), pose(m + 1, h)));
  }

  /// ahead_[m][h]: least cost of segments 0..m that end in each state under pose h.
  void sweepForward() {
    for (size_t m = 0; m < segments(); ++m) {
      if (m > 0) into_.push_back(mergeForward(m - 1));
      ahead_.emplace_back();
      std::vector<cv::Mat1f> costs = problem_.candidates[m].costs;
      for (size_t h = 0; h < poses(m); ++h) {
        ChainEdges springs = edges(m, h);
        passForward(m, springs, h, costs);
        ahead_[m].push_back(raised(workspace_.forward.back(), temporal(m, h)));
        if (m + 1 == segments()) keepIfBest(h, leastOf(ahead_[m][h]), std::move(springs));
      }
    }
  }

  /// Of the last segment's passes, so that tracing need not repeat it.
  void keepIfBest(size_t pose, double energy, ChainEdges springs) {
    if (energy >= best_.energy) return;
    best_ = {pose, energy, std::move(springs)};
    std::swap(workspace_.forward, workspace_.best_forward);
  }

  /// `costs`: of the segment's nodes, of which the first takes what the segments before say.
  void passForward(size_t m, const ChainEdges& edges, size_t h, std::vector<cv::Mat1f>& costs) {
    if (m > 0) costs.front() = into_[m - 1][h];
    forwardPass(costs, edges, workspace_);
  }

  /// The message from segment m to each pose of the next one: the least over its own poses.
  std::vector<cv::Mat1f> mergeForward(size_t m) const {
    const auto cost = [&](size_t from, size_t to) { return jointBetween(m, from, to); };
    return merge(ahead_[m], poses(m + 1), isFree(joint(m)), cost);
  }

  std::vector<cv::Mat1f> mergeBackward(size_t m) const {
    const auto cost = [&](size_t from, size_t to) { return jointBetween(m, to, from); };
    return merge(behind_[m + 1], poses(m), isFree(joint(m)), cost);
  }

  /// One message a receiving pose; a free joint sends the same one to all.
  template <typename Cost>
  static std::vector<cv::Mat1f> merge(const std::vector<cv::Mat1f>& maps, size_t receivers,
                                      bool free, const Cost& cost) {
    std::vector<cv::Mat1f> messages;
    for (size_t to = 0; to < (free ? 1 : receivers); ++to) {
      cv::Mat1f least = raised(maps.front(), free ? 0.0F : cost(0, to));
      for (size_t from = 1; from < maps.size(); ++from) {
        lower(least, free ? maps[from] : raised(maps[from], cost(from, to)));
      }
      messages.push_back(least);
    }
    messages.resize(receivers, messages.front());
    return messages;
  }

  /// behind_[m][h]: least cost of segments m.. that begin in each state under pose h.
  void sweepBackward() {
    behind_.resize(segments());
    from_.resize(segments());
    for (size_t m = segments() - 1; m > 0; --m) {
      std::vector<cv::Mat1f> costs = problem_.candidates[m].costs;
      std::reverse(costs.begin(), costs.end());
      for (size_t h = 0; h < poses(m); ++h) {
        if (m + 1 < segments()) costs.front() = from_[m][h];
        forwardPass(costs, edges(m, h).reversed(), workspace_);
        behind_[m].push_back(raised(workspace_.forward.back(), temporal(m, h)));
      }
      from_[m - 1] = mergeBackward(m - 1);
    }
  }

  cv::Mat1d energiesOf(size_t m) const {
    const PoseGrid& grid = problem_.poses[m];
    const bool last = m + 1 == segments();
    cv::Mat1d energies(grid.orientations, grid.scales, std::numeric_limits<double>::infinity());
    for (size_t h = 0; h < poses(m); ++h) {
      energies(grid.cellOf(h)) =
          last ? leastOf(ahead_[m][h]) : leastOf(sumOf(ahead_[m][h], from_[m][h]));
    }
    return energies;
  }

  /// From the last segment to the first: the pose that leads to where the next one begins.
  void traceChain(ChainMatch& match) {
    const size_t last = segments() - 1;
    match.segments[last].pose = best_.pose;
    std::swap(workspace_.forward, workspace_.best_forward);
    match.segments[last].states =
        traceBack(best_.edges, cheapestState(workspace_.forward.back()), workspace_);
    for (size_t m = last; m-- > 0;) {
      SegmentMatch& segment = match.segments[m];
      const SegmentMatch& next = match.segments[m + 1];
      segment.pose = bestInto(m, next);
      const ChainEdges springs = edges(m, segment.pose);
      std::vector<cv::Mat1f> costs = problem_.candidates[m].costs;
      passForward(m, springs, segment.pose, costs);
      segment.states = traceBack(springs, next.states.front(), workspace_);
    }
  }

  size_t bestInto(size_t m, const SegmentMatch& next) const {
    size_t best = 0;
    float least = std::numeric_limits<float>::infinity();
    for (size_t h = 0; h < poses(m); ++h) {
      const float cost = ahead_[m][h](next.states.front()) + jointBetween(m, h, next.pose);
      if (cost >= least) continue;
      least = cost;
      best = h;
    }
    return best;
  }

  struct BestPass {
    size_t pose = 0;
    double energy = std::numeric_limits<double>::infinity();
    ChainEdges edges;
  };

  const MatchingProblem& problem_;
  ChainSolverWorkspace& workspace_;
  BestPass best_;
  PoseMaps ahead_;
  PoseMaps behind_;
  PoseMaps into_;  // messages over the joint before segment m + 1
  PoseMaps from_;  // messages over the joint behind segment m
};

}  // namespace

ChainEdges sampleEdges(const SegmentLayout& segment, const SegmentCandidates& candidates,
                       const SegmentPose& pose) {
  return EdgeSampler(segment, candidates, pose).sample();
}

ChainMatch matchChain(const MatchingProblem& problem, ChainSolverWorkspace& workspace) {
  return Matcher(problem, workspace).match();
}

}  // namespace chain_tracker
