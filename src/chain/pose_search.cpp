// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/pose_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "chain_tracker/image/pixel_geometry.h"

namespace chain_tracker {
namespace {

double halfSquare(double x) { return 0.5 * x * x; }

/// Where the parabola through three equidistant values is least, in steps from the middle one,
/// which must be the smallest; 0 if it has no curvature or a value is infinite.
double parabolaMinimum(double before, double middle, double after) {
  const double curvature = before - 2.0 * middle + after;
  if (!std::isfinite(curvature) || curvature <= 0.0) return 0.0;
  return std::clamp(0.5 * (before - after) / curvature, -0.5, 0.5);
}

EdgeStencil sampleSpring(const EdgeLayout& edge, const SegmentPose& pose, int step) {
  const double length = pose.scale * edge.length;
  const EdgePotential potential{length, pose.orientation + edge.direction,
                                edge.stretch_sigma * length, edge.bend_sigma};
  return sampleEdge(onLattice(potential, step), step);
}

/// Index of the first edge equal to edge k: a grid of cells has only three different edges, and
/// sampling one costs more than passing its messages.
size_t firstEqualEdge(const std::vector<EdgeLayout>& edges, size_t k) {
  const auto equal = [&](const EdgeLayout& edge) {
    return std::abs(edge.length - edges[k].length) < 1e-6 &&
           std::abs(wrapAngle(edge.direction - edges[k].direction)) < 1e-6 &&
           edge.stretch_sigma == edges[k].stretch_sigma && edge.bend_sigma == edges[k].bend_sigma;
  };
  return static_cast<size_t>(std::find_if(edges.begin(), edges.end(), equal) - edges.begin());
}

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

RefinedPart refinePart(const CandidateGrid& grid, std::size_t part, const cv::Mat1f& marginal,
                       const cv::Point& state, double appearance) {
  const Bowl bowl(marginal, state);
  if (bowl.margin().width == 0 || bowl.margin().height == 0) {
    return {grid.positionOf(part, state), appearance,
            cv::Matx22d::all(std::numeric_limits<double>::quiet_NaN())};
  }
  const double step = grid.lattice.step;
  return {grid.positionOf(part, cv::Point2d(state) + minimumOffset(bowl)), appearance,
          covarianceOf(bowl) * (step * step)};
}

}  // namespace

SegmentPose PoseGrid::at(double row, double column) const {
  return {wrapAngle(middle.orientation + (row - orientations / 2) * orientation_step),
          middle.scale * std::exp((column - scales / 2) * scale_step)};
}

double temporalCost(const SegmentModel& model, const SegmentPose& previous,
                    const SegmentPose& pose) {
  const double turn = wrapAngle(pose.orientation - previous.orientation);
  const double growth = std::log(pose.scale / previous.scale);
  return halfSquare(turn / model.orientation_sigma) + halfSquare(growth / model.scale_sigma);
}

std::vector<EdgeStencil> sampleEdges(const SegmentLayout& segment, const CandidateGrid& grid,
                                     const SegmentPose& pose) {
  std::vector<EdgeStencil> samples(segment.edges.size());
  std::vector<EdgeStencil> stencils;
  for (size_t k = 0; k < segment.edges.size(); ++k) {
    const size_t twin = firstEqualEdge(segment.edges, k);
    if (twin == k) samples[k] = sampleSpring(segment.edges[k], pose, grid.lattice.step);
    stencils.push_back(betweenStates(samples[twin], grid.corners[k + 1] - grid.corners[k],
                                     grid.states - cv::Size(1, 1)));
  }
  return stencils;
}

PoseMatch searchPose(const SegmentLayout& segment, const SegmentModel& model,
                     const SegmentPose& previous, const PoseGrid& poses, const CandidateGrid& grid,
                     const std::vector<cv::Mat1f>& costs, ChainSolverWorkspace& workspace) {
  PoseMatch match;
  match.energies.create(poses.orientations, poses.scales);
  double least = std::numeric_limits<double>::infinity();
  for (int row = 0; row < poses.orientations; ++row) {
    for (int column = 0; column < poses.scales; ++column) {
      const SegmentPose pose = poses.at(row, column);
      const std::vector<EdgeStencil> edges = sampleEdges(segment, grid, pose);
      const double energy =
          forwardPass(costs, edges, workspace) + temporalCost(model, previous, pose);
      match.energies(row, column) = energy;
      if (energy >= least) continue;
      least = energy;
      match.row = row;
      match.column = column;
      match.states = traceBack(edges, workspace);
    }
  }
  return match;
}

SegmentPose interpolatePose(const PoseGrid& poses, const PoseMatch& match) {
  double row = match.row;
  double column = match.column;
  const cv::Mat1d& energies = match.energies;
  if (match.row > 0 && match.row + 1 < poses.orientations) {
    row += parabolaMinimum(energies(match.row - 1, match.column), match.energy(),
                           energies(match.row + 1, match.column));
  }
  if (match.column > 0 && match.column + 1 < poses.scales) {
    column += parabolaMinimum(energies(match.row, match.column - 1), match.energy(),
                              energies(match.row, match.column + 1));
  }
  return poses.at(row, column);
}

std::vector<RefinedPart> refineChain(const SegmentLayout& segment, const SegmentPose& pose,
                                     const CandidateGrid& grid, const std::vector<cv::Mat1f>& costs,
                                     ChainSolverWorkspace& workspace) {
  const std::vector<EdgeStencil> edges = sampleEdges(segment, grid, pose);
  if (!std::isfinite(forwardPass(costs, edges, workspace))) return {};
  const std::vector<cv::Point> states = traceBack(edges, workspace);
  std::vector<cv::Mat1f> marginals;
  minMarginals(costs, edges, marginals, workspace);
  std::vector<RefinedPart> parts;
  for (size_t k = 0; k < states.size(); ++k) {
    parts.push_back(refinePart(grid, k, marginals[k], states[k], costs[k](states[k])));
  }
  return parts;
}

}  // namespace chain_tracker
