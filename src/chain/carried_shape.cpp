// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/carried_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "chain_tracker/image/convex_hull.h"

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

CarriedShape::CarriedShape(const SegmentLayout& segment)
    : deformable_(segment.layout == Layout::kDeformable), corners_(segment.corners) {
  if (segment.layout == Layout::kPoints) {
    corners_ = segment.points;
    ConvexHull().replace(corners_);
  }
  const double orientation = segment.image_from_segment.angle;
  box_turns_ = deformable_ || segment.layout == Layout::kPoints ||
               !isUprightBox(segment.points, orientation);
  std::vector<cv::Point2d> unturned;
  for (const cv::Point2d& corner : corners_) {
    unturned.push_back(Similarity{orientation, 1.0, {}}.apply(corner));
  }
  if (!unturned.empty()) unturned_ = uprightBounds(unturned);
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

/// Of a deformable segment.
cv::Point2d CarriedShape::carried(const Anchor& anchor, const SegmentParts& parts) {
  return frameOfEdge(parts[anchor.part].position, parts[anchor.part + 1].position)
      .apply(anchor.point);
}

void CarriedShape::addPoints(const SegmentState& segment, const SegmentParts& parts,
                             std::vector<CarriedPoint>& points) const {
  for (const Anchor& anchor : anchors_) {
    const PartState& a = parts[anchor.part];
    if (!deformable_) {
      points.push_back({segment.image_from_segment.apply(anchor.point), a.confidence, a.visible});
      continue;
    }
    const PartState& b = parts[anchor.part + 1];
    points.push_back(
        {carried(anchor, parts), 0.5 * (a.confidence + b.confidence), a.visible && b.visible});
  }
}

void CarriedShape::addOutline(const SegmentState& segment, const SegmentParts& parts,
                              std::vector<cv::Point2d>& outline) const {
  if (!deformable_) {
    for (const cv::Point2d& corner : corners_) {
      outline.push_back(segment.image_from_segment.apply(corner));
    }
    return;
  }
  for (const Anchor& anchor : anchors_) outline.push_back(carried(anchor, parts));
  for (const PartState& part : parts) outline.push_back(part.position);
}

cv::Rect2d CarriedShape::box(const SegmentState& segment,
                             const std::vector<cv::Point2d>& outline) const {
  if (box_turns_) return uprightBounds(outline);
  const Similarity& pose = segment.image_from_segment;
  return {pose.scale * unturned_.tl() + pose.translation,
          pose.scale * unturned_.br() + pose.translation};
}

double partOrientation(const SegmentLayout& layout, const SegmentState& segment,
                       const SegmentParts& parts, size_t k) {
  if (layout.layout != Layout::kDeformable) return segment.image_from_segment.angle;
  const size_t before = k > 0 ? k - 1 : 0;
  const size_t after = std::min(k + 1, parts.size() - 1);
  return directionOf(parts[after].position - parts[before].position);
}

}  // namespace chain_tracker
