// SPDX-License-Identifier: BSD-3-Clause
#include "support/spring_chain.h"

#include <cmath>

#include "chain_tracker/chain/edge_stencil.h"

namespace chain_tracker {

SegmentLayout chainOf(const std::vector<EdgeLayout>& edges) {
  SegmentLayout segment;
  segment.edges = edges;
  segment.parts.push_back({{0.0, 0.0}, 10.0});
  for (const EdgeLayout& edge : edges) {
    const cv::Point2d vector(std::cos(edge.direction), std::sin(edge.direction));
    segment.parts.push_back({segment.parts.back().position + edge.length * vector, 10.0});
  }
  return segment;
}

std::vector<cv::Point2d> placed(const SegmentLayout& segment, const Similarity& transform) {
  std::vector<cv::Point2d> positions;
  for (const PartLayout& part : segment.parts) positions.push_back(transform.apply(part.position));
  return positions;
}

brute_force::EdgeCost springsOf(const SegmentLayout& segment, const SegmentPose& pose,
                                const SegmentCandidates& candidates) {
  return [=](size_t k, const cv::Point& from, const cv::Point& to) {
    const EdgeLayout& edge = segment.edges[k];
    const double length = pose.scale * edge.length;
    const double rounding = double(candidates.step) * candidates.step / 6.0;
    const double stretch = edge.stretch_sigma * length;
    const EdgePotential spring{
        length, pose.orientation + edge.direction, std::sqrt(stretch * stretch + rounding),
        std::sqrt(edge.bend_sigma * edge.bend_sigma + rounding / (length * length))};
    return brute_force::springCost(spring, candidates.positionOf(k + 1, cv::Point2d(to)) -
                                               candidates.positionOf(k, cv::Point2d(from)));
  };
}

}  // namespace chain_tracker
