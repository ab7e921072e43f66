// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/edge_stencil.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "chain_tracker/image/pixel_geometry.h"

namespace chain_tracker {
namespace {

constexpr double kCutOffSigmas = 3.0;
/// Against rounding where the cut-off is decided by cosines before it is by angles.
constexpr double kCosineSlack = 1e-9;

double square(double x) { return x * x; }

/// Edges against the direction in which the spring rests.
class DirectionFrame {
 public:
  explicit DirectionFrame(double direction)
      : axis_(std::cos(direction), std::sin(direction)), null_turn_(wrapAngle(-direction)) {}

  /// In [-pi, pi].
  double turnOf(const cv::Point2d& edge) const {
    // The null edge points along the x axis.
    if (edge == cv::Point2d()) return null_turn_;
    const double along = axis_.dot(edge);
    const double across = axis_.cross(edge);
    // The arc tangent of two arguments takes twice as long.
    return along > 0.0 ? std::atan(across / along) : std::atan2(across, along);
  }

  /// Cosine of the turn times the edge's length [px].
  double along(const cv::Point2d& edge) const { return axis_.dot(edge); }

 private:
  cv::Point2d axis_;
  double null_turn_;
};

/// Upright bounds of all edges within the cut-off [px].
cv::Rect2d cutOffBounds(const EdgePotential& potential) {
  const double low = std::max(0.0, potential.length - kCutOffSigmas * potential.length_sigma);
  const double high = potential.length + kCutOffSigmas * potential.length_sigma;
  const double spread = std::min(CV_PI, kCutOffSigmas * potential.direction_sigma);
  const auto at = [](double radius, double angle) {
    return cv::Point2d(radius * std::cos(angle), radius * std::sin(angle));
  };
  cv::Point2d least = at(low, potential.direction);
  cv::Point2d most = least;
  const auto add = [&](double angle) {
    for (const cv::Point2d& extreme : {at(low, angle), at(high, angle)}) {
      least = {std::min(least.x, extreme.x), std::min(least.y, extreme.y)};
      most = {std::max(most.x, extreme.x), std::max(most.y, extreme.y)};
    }
  };
  add(potential.direction - spread);
  add(potential.direction + spread);
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double axis = quarter * CV_PI / 2.0;
    if (std::abs(wrapAngle(axis - potential.direction)) <= spread) add(axis);
  }
  return {least, most};
}

/// For springs so stiff that the lattice misses their cut-off.
StencilOffset cheapestOffset(const EdgePotential& potential, int step, const cv::Point2d& shift) {
  const int reach = static_cast<int>(std::ceil(potential.length / step)) + 1;
  StencilOffset cheapest{0, 0, std::numeric_limits<float>::infinity()};
  for (int rows = -reach; rows <= reach; ++rows) {
    for (int columns = -reach; columns <= reach; ++columns) {
      const auto cost =
          static_cast<float>(potential.at(cv::Point2d(columns * step, rows * step) + shift));
      if (cost < cheapest.cost) cheapest = {columns, rows, cost};
    }
  }
  return cheapest;
}

}  // namespace

double EdgePotential::at(const cv::Point2d& edge) const {
  const double stretch = std::sqrt(edge.dot(edge)) - length;
  const double turn = DirectionFrame(direction).turnOf(edge);
  return 0.5 * square(stretch / length_sigma) + 0.5 * square(turn / direction_sigma);
}

EdgePotential onLattice(EdgePotential potential, double step) {
  const double rounding = square(step) / 6.0;
  potential.length_sigma = std::sqrt(square(potential.length_sigma) + rounding);
  potential.direction_sigma =
      std::sqrt(square(potential.direction_sigma) + rounding / square(potential.length));
  return potential;
}

void sampleEdge(const EdgePotential& potential, int step, const cv::Point2d& shift,
                EdgeStencil& stencil) {
  const cv::Rect2d bounds = cutOffBounds(potential) - shift;
  // One step more than the bounds, which are rounded; the loop looks at each offset exactly.
  const auto first = [&](double low) { return static_cast<int>(std::floor(low / step)); };
  const auto last = [&](double high) { return static_cast<int>(std::ceil(high / step)); };
  const DirectionFrame frame(potential.direction);
  // Spares most offsets the arc tangent, which costs more than all else here.
  const double widest_turn = std::min(CV_PI, kCutOffSigmas * potential.direction_sigma);
  const double least_cosine = std::cos(widest_turn) - kCosineSlack;
  stencil.clear();
  for (int rows = first(bounds.y); rows <= last(bounds.br().y); ++rows) {
    for (int columns = first(bounds.x); columns <= last(bounds.br().x); ++columns) {
      const cv::Point2d edge = cv::Point2d(columns * step, rows * step) + shift;
      const double length = std::sqrt(edge.dot(edge));
      const double stretch = (length - potential.length) / potential.length_sigma;
      if (std::abs(stretch) > kCutOffSigmas || frame.along(edge) < least_cosine * length) continue;
      const double turn = frame.turnOf(edge) / potential.direction_sigma;
      if (std::abs(turn) > kCutOffSigmas) continue;
      const double cost = 0.5 * square(stretch) + 0.5 * square(turn);
      stencil.push_back({columns, rows, static_cast<float>(cost)});
    }
  }
  if (stencil.empty()) stencil.push_back(cheapestOffset(potential, step, shift));
}

void betweenStates(const EdgeStencil& stencil, const cv::Point& origin, const cv::Size& reach,
                   EdgeStencil& shifted) {
  shifted.clear();
  for (const StencilOffset& offset : stencil) {
    const int columns = offset.columns - origin.x;
    const int rows = offset.rows - origin.y;
    if (std::abs(columns) > reach.width || std::abs(rows) > reach.height) continue;
    shifted.push_back({columns, rows, offset.cost});
  }
}

void reverse(EdgeStencil& stencil) {
  for (StencilOffset& offset : stencil) {
    offset.columns = -offset.columns;
    offset.rows = -offset.rows;
  }
}

}  // namespace chain_tracker
