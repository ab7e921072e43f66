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

/// Minimum of a quadratic through a min-marginal's 3 x 3 neighbourhood of the best state.
struct QuadraticMinimum {
  cv::Point2d offset;      // from the best state [lattice steps], within half a step
  cv::Matx22d covariance;  // inverse of the Hessian [lattice steps^2]
};

QuadraticMinimum fitQuadratic(const cv::Mat1f& marginal, const cv::Point& state) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  QuadraticMinimum minimum{{0.0, 0.0}, cv::Matx22d::all(unknown)};
  const cv::Rect inner(1, 1, marginal.cols - 2, marginal.rows - 2);
  if (!inner.contains(state)) return minimum;
  const auto at = [&](int dx, int dy) -> double { return marginal(state.y + dy, state.x + dx); };
  const double xx = at(-1, 0) - 2.0 * at(0, 0) + at(1, 0);
  const double yy = at(0, -1) - 2.0 * at(0, 0) + at(0, 1);
  const double xy = 0.25 * (at(1, 1) + at(-1, -1) - at(1, -1) - at(-1, 1));
  const double determinant = xx * yy - xy * xy;
  if (!std::isfinite(determinant) || xx <= 0.0 || yy <= 0.0 || determinant <= 0.0) return minimum;
  minimum.covariance = cv::Matx22d(yy, -xy, -xy, xx) * (1.0 / determinant);
  const double x = 0.5 * (at(1, 0) - at(-1, 0));
  const double y = 0.5 * (at(0, 1) - at(0, -1));
  minimum.offset = {std::clamp((xy * y - yy * x) / determinant, -0.5, 0.5),
                    std::clamp((xy * x - xx * y) / determinant, -0.5, 0.5)};
  return minimum;
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
  const double step = grid.lattice.step;
  std::vector<RefinedPart> parts;
  for (size_t k = 0; k < states.size(); ++k) {
    const QuadraticMinimum minimum = fitQuadratic(marginals[k], states[k]);
    parts.push_back({grid.positionOf(k, cv::Point2d(states[k]) + minimum.offset),
                     costs[k](states[k]), minimum.covariance * (step * step)});
  }
  return parts;
}

}  // namespace chain_tracker
