// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/carried_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <opencv2/imgproc.hpp>

namespace chain_tracker {
namespace {

/// Where a line doubles back on itself, two parts may coincide; their edge has no direction that
/// could carry a point [px].
constexpr double kShortestEdge = 1.0;

/// The frame whose unit vector along x is the edge from a to b.
Similarity frameOfEdge(const cv::Point2d& a, const cv::Point2d& b) {
  return {directionOf(b - a), std::max(cv::norm(b - a), 1e-9), a};
}

double distanceToEdge(const cv::Point2d& point, const cv::Point2d& a, const cv::Point2d& b) {
  const cv::Point2d local = frameOfEdge(a, b).applyInverse(point);
  const cv::Point2d nearest = frameOfEdge(a, b).apply({std::clamp(local.x, 0.0, 1.0), 0.0});
  return cv::norm(point - nearest);
}

size_t nearestEdge(const std::vector<PartLayout>& parts, const cv::Point2d& point) {
  size_t nearest = 0;
  double nearest_distance = std::numeric_limits<double>::infinity();
  for (size_t k = 0; k + 1 < parts.size(); ++k) {
    if (cv::norm(parts[k + 1].position - parts[k].position) < kShortestEdge) continue;
    const double distance = distanceToEdge(point, parts[k].position, parts[k + 1].position);
    if (distance < nearest_distance) {
      nearest_distance = distance;
      nearest = k;
    }
  }
  return nearest;
}

size_t nearestPart(const std::vector<PartLayout>& parts, const cv::Point2d& point) {
  const auto nearer = [&](const PartLayout& a, const PartLayout& b) {
    return cv::norm(a.position - point) < cv::norm(b.position - point);
  };
  return static_cast<size_t>(std::min_element(parts.begin(), parts.end(), nearer) - parts.begin());
}

/// Whether the object was given by the corners of a box with sides parallel to the image's.
bool isUprightBox(const std::vector<cv::Point2d>& points, double orientation) {
  if (points.size() != 4) return false;
  const double side = directionOf(points[1] - points[0]) + orientation;
  return std::abs(std::sin(2.0 * side)) < 1e-6;
}

}  // namespace

std::vector<cv::Point2d> hullOf(const std::vector<cv::Point2d>& points) {
  const std::vector<cv::Point2f> corners(points.begin(), points.end());
  std::vector<cv::Point2f> hull;
  cv::convexHull(corners, hull);
  return {hull.begin(), hull.end()};
}

CarriedShape::CarriedShape(const SegmentLayout& segment)
    : deformable_(segment.layout == Layout::kDeformable),
      initial_orientation_(segment.image_from_segment.angle),
      corners_(segment.corners) {
  if (segment.layout == Layout::kPoints) corners_ = hullOf(segment.points);
  box_turns_ = deformable_ || segment.layout == Layout::kPoints ||
               !isUprightBox(segment.points, initial_orientation_);
  for (const cv::Point2d& point : segment.points) {
    if (!deformable_) {
      anchors_.push_back({point, nearestPart(segment.parts, point)});
      continue;
    }
    const size_t k = nearestEdge(segment.parts, point);
    const Similarity frame = frameOfEdge(segment.parts[k].position, segment.parts[k + 1].position);
    anchors_.push_back({frame.applyInverse(point), k});
  }
}

std::vector<CarriedPoint> CarriedShape::points(const SegmentState& segment,
                                               const std::vector<PartState>& parts) const {
  std::vector<CarriedPoint> points;
  points.reserve(anchors_.size());
  for (const Anchor& anchor : anchors_) {
    if (!deformable_) {
      const PartState& part = parts[anchor.part];
      points.push_back(
          {segment.image_from_segment.apply(anchor.point), part.confidence, part.visible});
      continue;
    }
    const PartState& a = parts[anchor.part];
    const PartState& b = parts[anchor.part + 1];
    points.push_back({frameOfEdge(a.position, b.position).apply(anchor.point),
                      0.5 * (a.confidence + b.confidence), a.visible && b.visible});
  }
  return points;
}

std::vector<cv::Point2d> CarriedShape::outline(const SegmentState& segment,
                                               const std::vector<PartState>& parts) const {
  std::vector<cv::Point2d> outline;
  if (deformable_) {
    for (const CarriedPoint& point : points(segment, parts)) outline.push_back(point.position);
    for (const PartState& part : parts) outline.push_back(part.position);
    return hullOf(outline);
  }
  for (const cv::Point2d& corner : corners_) {
    outline.push_back(segment.image_from_segment.apply(corner));
  }
  return outline;
}

cv::Rect2d CarriedShape::box(const SegmentState& segment,
                             const std::vector<PartState>& parts) const {
  if (box_turns_) return uprightBounds(outline(segment, parts));
  SegmentState unturned = segment;
  unturned.image_from_segment.angle = initial_orientation_;
  return uprightBounds(outline(unturned, parts));
}

std::vector<double> partOrientations(const SegmentLayout& layout, const SegmentState& segment,
                                     const std::vector<PartState>& parts) {
  std::vector<double> orientations(parts.size(), segment.image_from_segment.angle);
  if (layout.layout != Layout::kDeformable) return orientations;
  for (size_t k = 0; k < parts.size(); ++k) {
    const size_t before = k > 0 ? k - 1 : 0;
    const size_t after = std::min(k + 1, parts.size() - 1);
    orientations[k] = directionOf(parts[after].position - parts[before].position);
  }
  return orientations;
}

}  // namespace chain_tracker
