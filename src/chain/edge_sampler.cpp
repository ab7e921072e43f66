// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/edge_sampler.h"

#include <cmath>

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

void sampleSpring(const EdgeLayout& edge, const SegmentPose& pose, int step,
                  const cv::Point2d& shift, EdgeStencil& stencil) {
  const double length = pose.scale * edge.length;
  const EdgePotential potential{length, pose.orientation + edge.direction,
                                edge.stretch_sigma * length, edge.bend_sigma};
  sampleEdge(onLattice(potential, step), step, shift, stencil);
}

/// Whether a spring would be the other one if it were turned by `turn` [rad].
bool areAlike(const EdgeLayout& a, const EdgeLayout& b, double turn) {
  return std::abs(a.length - b.length) < 1e-6 &&
         std::abs(wrapAngle(a.direction + turn - b.direction)) < 1e-6 &&
         a.stretch_sigma == b.stretch_sigma && a.bend_sigma == b.bend_sigma;
}

}  // namespace

struct EdgeSampler::Request {
  const SegmentLayout& segment;
  const SegmentCandidates& candidates;
  const SegmentPose& pose;
};

void EdgeSampler::sample(const SegmentLayout& segment, const SegmentCandidates& candidates,
                         const SegmentPose& pose, ChainEdges& edges) {
  used_ = 0;
  edges.clear();
  for (size_t k = 0; k < segment.edges.size(); ++k) {
    edges.addEdge(kindOf({segment, candidates, pose}, k, edges));
  }
}

/// The spring sampled that is alike when turned, or null.
EdgeSampler::Spring* EdgeSampler::sampled(const Request& request, size_t edge,
                                          const cv::Point2d& rest, double turn) {
  const std::vector<EdgeLayout>& edges = request.segment.edges;
  for (size_t i = 0; i < used_; ++i) {
    Spring& spring = springs_[i];
    if (spring.rest == rest && areAlike(edges[spring.edge], edges[edge], turn)) return &spring;
  }
  return nullptr;
}

EdgeSampler::Spring& EdgeSampler::newSpring(size_t edge, const cv::Point2d& rest) {
  if (used_ == springs_.size()) springs_.emplace_back();
  Spring& spring = springs_[used_++];
  spring.edge = edge;
  spring.rest = rest;
  spring.kinds.clear();
  return spring;
}

EdgeSampler::Spring& EdgeSampler::springOf(const Request& request, size_t edge,
                                           const cv::Point2d& rest) {
  if (Spring* const same = sampled(request, edge, rest, 0.0)) return *same;
  Spring& spring = newSpring(edge, rest);
  if (const Spring* const opposite = sampled(request, edge, -rest, CV_PI)) {
    spring.stencil = opposite->stencil;
    reverse(spring.stencil);
  } else {
    sampleSpring(request.segment.edges[edge], request.pose, request.candidates.step, rest,
                 spring.stencil);
  }
  return spring;
}

size_t EdgeSampler::kindOf(const Request& request, size_t edge, ChainEdges& edges) {
  const LatticeShift shift = shiftBetween(request.candidates, edge);
  Spring& spring = springOf(request, edge, shift.rest);
  for (const auto& [steps, kind] : spring.kinds) {
    if (steps == shift.steps) return kind;
  }
  const size_t kind = edges.kinds();
  const cv::Size reach = request.candidates.states - cv::Size(1, 1);
  betweenStates(spring.stencil, shift.steps, reach, edges.addKind());
  spring.kinds.emplace_back(shift.steps, kind);
  return kind;
}

}  // namespace chain_tracker
