// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/chain_refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace chain_tracker {
namespace {

/// A min-marginal around the best state.
class Bowl {
 public:
  Bowl(const cv::Mat1f& marginal, const cv::Point& state) : marginal_(marginal), state_(state) {}

  /// States on all sides of the best one.
  cv::Size margin() const {
    return {std::min(state_.x, marginal_.cols - 1 - state_.x),
            std::min(state_.y, marginal_.rows - 1 - state_.y)};
  }

  double at(int dx, int dy) const { return marginal_(state_.y + dy, state_.x + dx); }

  /// Second differences over `reach` states to each side: the Hessian [1 / states^2].
  cv::Matx22d hessian(const cv::Size& reach) const {
    const int w = reach.width;
    const int h = reach.height;
    const double xx = (at(-w, 0) - 2.0 * at(0, 0) + at(w, 0)) / (w * w);
    const double yy = (at(0, -h) - 2.0 * at(0, 0) + at(0, h)) / (h * h);
    const double xy = (at(w, h) + at(-w, -h) - at(w, -h) - at(-w, h)) / (4.0 * w * h);
    return {xx, xy, xy, yy};
  }

  /// Where it has risen by half, as a Gaussian has at one standard deviation, or where it ends.
  /// Nearer to the bottom, messages show the steps of the lattice rather than the curvature.
  cv::Size reachOfOneSigma() const {
    constexpr double kRise = 0.5;
    cv::Size reach(1, 1);
    const double bottom = at(0, 0);
    while (reach.width < margin().width &&
           0.5 * (at(-reach.width, 0) + at(reach.width, 0)) - bottom < kRise) {
      ++reach.width;
    }
    while (reach.height < margin().height &&
           0.5 * (at(0, -reach.height) + at(0, reach.height)) - bottom < kRise) {
      ++reach.height;
    }
    return reach;
  }

 private:
  const cv::Mat1f& marginal_;
  cv::Point state_;
};

bool isPositiveDefinite(const cv::Matx22d& matrix) {
  const double determinant = cv::determinant(matrix);
  return std::isfinite(determinant) && matrix(0, 0) > 0.0 && determinant > 0.0;
}

/// Minimum of the quadratic through the 3 x 3 neighbourhood, within half a state of the best one.
cv::Point2d minimumOffset(const Bowl& bowl) {
  const cv::Matx22d hessian = bowl.hessian({1, 1});
  if (!isPositiveDefinite(hessian)) return {0.0, 0.0};
  const cv::Vec2d slope(0.5 * (bowl.at(1, 0) - bowl.at(-1, 0)),
                        0.5 * (bowl.at(0, 1) - bowl.at(0, -1)));
  const cv::Vec2d offset = -(hessian.inv() * slope);
  return {std::clamp(offset[0], -0.5, 0.5), std::clamp(offset[1], -0.5, 0.5)};
}

/// Inverse of the Hessian [states^2]; NaN if it is none of a minimum.
cv::Matx22d covarianceOf(const Bowl& bowl) {
  cv::Matx22d hessian = bowl.hessian(bowl.reachOfOneSigma());
  if (isPositiveDefinite(hessian)) return hessian.inv();
  // Far from the bottom a bowl may be no quadratic any more; its axes still tell its width.
  hessian(0, 1) = hessian(1, 0) = 0.0;
  if (isPositiveDefinite(hessian)) return hessian.inv();
  return cv::Matx22d::all(std::numeric_limits<double>::quiet_NaN());
}

RefinedPart refinePart(const SegmentCandidates& candidates, std::size_t node,
                       const cv::Mat1f& marginal, const cv::Point& state) {
  const double appearance = candidates.costs[node](state);
  const Bowl bowl(marginal, state);
  if (bowl.margin().width == 0 || bowl.margin().height == 0) {
    return {candidates.positionOf(node, state), appearance,
            cv::Matx22d::all(std::numeric_limits<double>::quiet_NaN())};
  }
  const double step = candidates.step;
  return {candidates.positionOf(node, cv::Point2d(state) + minimumOffset(bowl)), appearance,
          covarianceOf(bowl) * (step * step)};
}

/// The segments' chains as one; the joint between two segments is one node.
void join(const std::vector<SegmentLayout>& segments, const std::vector<SegmentPose>& poses,
          const std::vector<SegmentCandidates>& candidates, ChainRefinementWorkspace& chain) {
  chain.edges.clear();
  chain.costs.clear();
  for (std::size_t m = 0; m < segments.size(); ++m) {
    chain.sampler.sample(segments[m], candidates[m], poses[m], chain.segment_edges);
    chain.edges.append(chain.segment_edges);
    const auto own = candidates[m].costs.begin() + (segments[m].entry ? 1 : 0);
    chain.costs.insert(chain.costs.end(), own, candidates[m].costs.end());
  }
}

}  // namespace

const std::vector<RefinedPart>& refineChain(const std::vector<SegmentLayout>& segments,
                                            const std::vector<SegmentPose>& poses,
                                            const std::vector<SegmentCandidates>& candidates,
                                            ChainRefinementWorkspace& workspace) {
  ChainSolverWorkspace& solver = workspace.solver;
  const std::vector<cv::Mat1f>& marginals = workspace.marginals;
  const std::vector<cv::Point>& states = workspace.states;
  std::vector<RefinedPart>& parts = workspace.parts;
  parts.clear();
  join(segments, poses, candidates, workspace);
  if (!std::isfinite(forwardPass(workspace.costs, workspace.edges, solver))) return parts;
  traceBack(workspace.edges, cheapestState(solver.forward.back()), solver, workspace.states);
  minMarginals(workspace.costs, workspace.edges, workspace.marginals, solver);
  std::size_t first = 0;  // node of the joined chain at which the segment begins
  for (std::size_t m = 0; m < segments.size(); ++m) {
    const std::size_t joint = segments[m].entry ? 1 : 0;
    for (std::size_t k = joint; k < joint + segments[m].parts.size(); ++k) {
      parts.push_back(refinePart(candidates[m], k, marginals[first + k], states[first + k]));
    }
    first += segments[m].edges.size();
  }
  return parts;
}

}  // namespace chain_tracker
