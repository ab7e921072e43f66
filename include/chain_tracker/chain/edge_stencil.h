// SPDX-License-Identifier: BSD-3-Clause
/// The spring between two neighbouring parts (thesis ch. 3.2.2), sampled on a lattice of positions.
///
/// With (rho, psi) the polar coordinates of the edge p_{k+1} - p_k:
///   V(p_{k+1} - p_k) = (rho - l)^2 / (2 sigma_l^2) + wrap(psi - phi)^2 / (2 sigma_phi^2).
/// A stretched spring of this kind is anisotropic and turned with its segment, so it does not
/// separate along the lattice's axes; it is cut off at three standard deviations instead, which
/// keeps the number of offsets small and independent of the search window, and takes the true
/// polar potential. Positions on a lattice of step h carry a rounding error of variance h^2/12 an
/// axis, an edge one of h^2/6, which joins both variances: without it, springs favour the
/// orientations whose rest offsets happen to meet lattice points.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace chain_tracker {

struct EdgePotential {
  double length = 0.0;           ///< rest length l [px], > 0
  double direction = 0.0;        ///< rest direction phi in the image [rad]
  double length_sigma = 0.0;     ///< [px], > 0
  double direction_sigma = 0.0;  ///< [rad], > 0

  /// V at an edge vector [px], without cut-off.
  double at(const cv::Point2d& edge) const;
};

/// The same spring with the variance that a lattice of `step` [px] adds.
EdgePotential onLattice(EdgePotential potential, double step);

struct StencilOffset {
  int columns = 0;  ///< of the second part's state against the first's [lattice steps]
  int rows = 0;
  float cost = 0.0F;
};

using EdgeStencil = std::vector<StencilOffset>;

/// `stencil` becomes the edges within three standard deviations whose vector is a whole number of
/// steps plus `shift` [px], and their costs; at least the cheapest one. `shift` is what separates
/// the lattices of the two parts, less than a step. O(offsets).
void sampleEdge(const EdgePotential& potential, int step, const cv::Point2d& shift,
                EdgeStencil& stencil);

/// `shifted` becomes the same offsets counted between two parts' states when the second part's
/// state (0, 0) lies `origin` steps from the first part's. Offsets of more than `reach` columns or
/// rows join no two states and are left out.
void betweenStates(const EdgeStencil& stencil, const cv::Point& origin, const cv::Size& reach,
                   EdgeStencil& shifted);

/// The same edge seen from its other end.
void reverse(EdgeStencil& stencil);

}  // namespace chain_tracker
