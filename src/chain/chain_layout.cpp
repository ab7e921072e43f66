// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/chain_layout.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

namespace chain_tracker {
namespace {

/// Two points nearer than this are taken for one [px].
constexpr double kSamePoint = 1.0;

struct OrientedRectangle {
  cv::Point2d center;
  double angle = 0.0;   // of the side called length [rad]
  double length = 0.0;  // [px]
  double width = 0.0;   // [px]
};

std::string textOf(const cv::Point2d& point) {
  std::ostringstream text;
  text << "(" << point.x << ", " << point.y << ")";
  return text.str();
}

[[noreturn]] void refuse(const std::string& reason) { throw std::invalid_argument(reason); }

void requireFinite(const std::vector<cv::Point2d>& points) {
  for (size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points[i].x) || !std::isfinite(points[i].y)) {
      refuse("point " + std::to_string(i) + " is " + textOf(points[i]) + ", must be finite");
    }
  }
}

void requireApart(const std::vector<cv::Point2d>& points, size_t i, size_t j) {
  if (cv::norm(points[i] - points[j]) >= kSamePoint) return;
  refuse("points " + std::to_string(i) + " and " + std::to_string(j) + " are both at " +
         textOf(points[i]) + ", must be at least 1 px apart");
}

OrientedRectangle rectangleFromEnds(const std::vector<cv::Point2d>& ends, double aspect) {
  requireApart(ends, 0, 1);
  const cv::Point2d axis = ends[1] - ends[0];
  const double length = cv::norm(axis);
  return {(ends[0] + ends[1]) / 2.0, directionOf(axis), length, aspect * length};
}

OrientedRectangle rectangleFromCorners(const std::vector<cv::Point2d>& corners) {
  for (size_t i = 0; i < 4; ++i) {
    for (size_t j = i + 1; j < 4; ++j) requireApart(corners, i, j);
  }
  const cv::Point2d center = (corners[0] + corners[1] + corners[2] + corners[3]) / 4.0;
  const cv::Point2d along = (corners[1] - corners[0] + corners[2] - corners[3]) / 2.0;
  const cv::Point2d across = (corners[3] - corners[0] + corners[2] - corners[1]) / 2.0;
  if (std::abs(along.cross(across)) < kSamePoint) {
    refuse("the four corners from " + textOf(corners[0]) + " to " + textOf(corners[3]) +
           " enclose no area, must be given in order around a rectangle");
  }
  return {center, directionOf(along), cv::norm(along), cv::norm(across)};
}

void turnLengthwise(OrientedRectangle& rectangle) {
  if (rectangle.length >= rectangle.width) return;
  std::swap(rectangle.length, rectangle.width);
  rectangle.angle = wrapAngle(rectangle.angle + CV_PI / 2.0);
}

/// By a fraction of its size on every side.
OrientedRectangle grown(OrientedRectangle rectangle, double margin) {
  const double growth = 2.0 * margin * std::sqrt(rectangle.length * rectangle.width);
  rectangle.length += growth;
  rectangle.width += growth;
  return rectangle;
}

/// Columns (along the length) and rows (across) of nearly square cells, nearly `parts` in all.
cv::Size chooseGrid(double length, double width, int parts) {
  cv::Size best(parts, 1);
  double best_score = std::numeric_limits<double>::infinity();
  for (int rows = 1; rows <= parts; ++rows) {
    const int columns = std::max(1, static_cast<int>(std::lround(double(parts) / rows)));
    if (rows * columns < 2) continue;
    const double squareness = std::abs(std::log((length / columns) / (width / rows)));
    const double count = std::abs(std::log(double(rows * columns) / parts));
    if (squareness + 2.0 * count < best_score) {
      best_score = squareness + 2.0 * count;
      best = {columns, rows};
    }
  }
  return best;
}

/// Cells visited like a plough: across the object, one step along it, back across, ...
std::vector<PartLayout> serpentine(const OrientedRectangle& rectangle, const SegmentModel& model) {
  const cv::Size grid = chooseGrid(rectangle.length, rectangle.width, model.parts);
  const double step_along = rectangle.length / grid.width;
  const double step_across = rectangle.width / grid.height;
  const double side = model.window * std::sqrt(step_along * step_across);
  std::vector<PartLayout> parts;
  for (int column = 0; column < grid.width; ++column) {
    for (int i = 0; i < grid.height; ++i) {
      const int row = column % 2 == 0 ? i : grid.height - 1 - i;
      parts.push_back({{(column + 0.5) * step_along - rectangle.length / 2.0,
                        (row + 0.5) * step_across - rectangle.width / 2.0},
                       side});
    }
  }
  return parts;
}

std::vector<cv::Point2d> cornersOf(double length, double width) {
  const double x = length / 2.0;
  const double y = width / 2.0;
  return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

std::vector<cv::Point2d> applyAll(const Similarity& transform, std::vector<cv::Point2d> points) {
  for (cv::Point2d& point : points) point = transform.apply(point);
  return points;
}

std::vector<cv::Point2d> applyInverseAll(const Similarity& transform,
                                         std::vector<cv::Point2d> points) {
  for (cv::Point2d& point : points) point = transform.applyInverse(point);
  return points;
}

SegmentLayout layOutRectangle(const SegmentModel& model, const std::vector<cv::Point2d>& points) {
  const bool elongated = model.layout == Layout::kElongated;
  if (points.size() != 4 && !(elongated && points.size() == 2)) {
    refuse("segment " + model.name + " was given " + std::to_string(points.size()) +
           (elongated ? " points, must be the 2 ends or the 4 corners of a rectangle"
                      : " points, must be the 4 corners of a rectangle"));
  }
  OrientedRectangle rectangle =
      points.size() == 2 ? rectangleFromEnds(points, model.aspect) : rectangleFromCorners(points);
  if (elongated) turnLengthwise(rectangle);
  SegmentLayout segment;
  segment.image_from_segment = {rectangle.angle, 1.0, rectangle.center};
  segment.parts = serpentine(grown(rectangle, model.margin), model);
  segment.corners = cornersOf(rectangle.length, rectangle.width);
  return segment;
}

/// `count` points in equal steps of arc length from the first point to the last.
std::vector<cv::Point2d> resample(const std::vector<cv::Point2d>& polyline, int count) {
  const double step = lengthOf(polyline) / (count - 1);
  std::vector<cv::Point2d> samples = {polyline.front()};
  double travelled = 0.0;
  for (size_t i = 1; i < polyline.size(); ++i) {
    const cv::Point2d edge = polyline[i] - polyline[i - 1];
    const double length = cv::norm(edge);
    while (static_cast<int>(samples.size()) < count - 1 &&
           static_cast<double>(samples.size()) * step <= travelled + length) {
      const double rest = static_cast<double>(samples.size()) * step - travelled;
      samples.push_back(polyline[i - 1] + edge * (rest / length));
    }
    travelled += length;
  }
  samples.push_back(polyline.back());
  return samples;
}

/// A chain along the centres, whose windows are `window` mean steps wide; its box bounds the
/// points.
SegmentLayout layOutAlong(const std::vector<cv::Point2d>& centers, double window,
                          const std::vector<cv::Point2d>& points) {
  cv::Point2d mean;
  for (const cv::Point2d& center : centers) mean += center / double(centers.size());
  SegmentLayout segment;
  segment.image_from_segment = {directionOf(points.back() - points.front()), 1.0, mean};
  const double side = window * lengthOf(points) / static_cast<double>(centers.size() - 1);
  for (const cv::Point2d& center : centers) {
    segment.parts.push_back({segment.image_from_segment.applyInverse(center), side});
  }
  const cv::Rect2d box = uprightBounds(points);
  const cv::Point2d high = box.br();
  segment.corners = applyInverseAll(segment.image_from_segment,
                                    {box.tl(), {high.x, box.y}, high, {box.x, high.y}});
  return segment;
}

/// `what`: the points have to be.
void requireLine(const SegmentModel& model, const std::vector<cv::Point2d>& points,
                 const std::string& what) {
  if (points.size() < 2) {
    refuse("segment " + model.name + " was given " + std::to_string(points.size()) +
           " points, must be " + what);
  }
  for (size_t i = 1; i < points.size(); ++i) requireApart(points, i - 1, i);
}

SegmentLayout layOutPolyline(const SegmentModel& model, const std::vector<cv::Point2d>& points) {
  requireLine(model, points, "a polyline of at least 2");
  return layOutAlong(resample(points, model.parts), model.window, points);
}

SegmentLayout layOutPoints(const SegmentModel& model, const std::vector<cv::Point2d>& points) {
  requireLine(model, points, "the middles of at least 2 parts");
  return layOutAlong(points, model.window, points);
}

std::vector<EdgeLayout> edgesOf(const SegmentLayout& segment, const SegmentModel& model) {
  const std::vector<cv::Point2d> nodes = nodesOf(segment);
  std::vector<EdgeLayout> edges;
  for (size_t k = 1; k < nodes.size(); ++k) {
    const cv::Point2d edge = nodes[k] - nodes[k - 1];
    edges.push_back({cv::norm(edge), directionOf(edge), model.stretch_sigma, model.bend_sigma});
  }
  return edges;
}

SegmentLayout layOutShape(const SegmentModel& model, const std::vector<cv::Point2d>& points) {
  switch (model.layout) {
    case Layout::kDeformable:
      return layOutPolyline(model, points);
    case Layout::kPoints:
      return layOutPoints(model, points);
    default:
      return layOutRectangle(model, points);
  }
}

SegmentLayout layOutSegment(const SegmentModel& model, const std::vector<cv::Point2d>& points) {
  SegmentLayout segment = layOutShape(model, points);
  segment.name = model.name;
  segment.layout = model.layout;
  segment.points = applyInverseAll(segment.image_from_segment, points);
  return segment;
}

/// Parts in the middles of equal pieces of the polyline: none of them on a joint.
void centerBetweenEnds(SegmentLayout& segment, const std::vector<cv::Point2d>& points) {
  const int count = static_cast<int>(segment.parts.size());
  const std::vector<cv::Point2d> halves = resample(points, 2 * count + 1);
  for (size_t k = 0; k < segment.parts.size(); ++k) {
    segment.parts[k].position = segment.image_from_segment.applyInverse(halves[2 * k + 1]);
    segment.parts[k].side *= double(count - 1) / count;
  }
}

void requireVertices(const ChainModel& model, const std::vector<cv::Point2d>& points) {
  if (points.size() == model.segments.size() + 1) return;
  refuse("model " + model.name + " was given " + std::to_string(points.size()) +
         " points, must be the " + std::to_string(model.segments.size() + 1) + " vertices of its " +
         std::to_string(model.segments.size()) + " joined segments");
}

/// Segments between the vertices of a polyline, joined there.
std::vector<SegmentLayout> layOutJoined(const ChainModel& model,
                                        const std::vector<cv::Point2d>& points) {
  requireVertices(model, points);
  for (size_t i = 1; i < points.size(); ++i) requireApart(points, i - 1, i);
  std::vector<SegmentLayout> segments;
  for (size_t m = 0; m < model.segments.size(); ++m) {
    const std::vector<cv::Point2d> ends = {points[m], points[m + 1]};
    SegmentLayout segment = layOutSegment(model.segments[m], ends);
    if (segment.layout == Layout::kDeformable) centerBetweenEnds(segment, ends);
    if (m > 0) segment.entry = segment.points.front();
    if (m + 1 < model.segments.size()) segment.exit = segment.points.back();
    segments.push_back(std::move(segment));
  }
  return segments;
}

/// A stroke as wide as the segments are on average, or as the windows around points; the rectangle
/// of a single segment of cells.
Silhouette silhouetteOf(const ChainModel& model, const std::vector<SegmentLayout>& segments,
                        const std::vector<cv::Point2d>& points) {
  if (segments.front().layout == Layout::kPoints) return {points, segments.front().parts[0].side};
  if (segments.size() == 1 && segments.front().layout != Layout::kDeformable) {
    return {applyAll(segments.front().image_from_segment, segments.front().corners), 0.0};
  }
  double width = 0.0;
  for (size_t m = 0; m < segments.size(); ++m) {
    const std::vector<cv::Point2d> line =
        applyAll(segments[m].image_from_segment, segments[m].points);
    width += model.segments[m].aspect * lengthOf(line) / double(segments.size());
  }
  return {points, width};
}

}  // namespace

std::vector<cv::Point2d> nodesOf(const SegmentLayout& segment) {
  std::vector<cv::Point2d> nodes;
  if (segment.entry) nodes.push_back(*segment.entry);
  for (const PartLayout& part : segment.parts) nodes.push_back(part.position);
  if (segment.exit) nodes.push_back(*segment.exit);
  return nodes;
}

double chainLengthOf(const SegmentLayout& segment) {
  double length = 0.0;
  for (const EdgeLayout& edge : segment.edges) length += edge.length;
  return length;
}

ChainLayout layOut(const ChainModel& model, const std::vector<cv::Point2d>& points) {
  requireFinite(points);
  if (model.segment_per_edge) {  // forPolyline() found no edge
    refuse("model " + model.name + " was given " + std::to_string(points.size()) +
           " points, must be a polyline of at least 2");
  }
  ChainLayout layout;
  if (model.segments.size() == 1) {
    layout.segments = {layOutSegment(model.segments.front(), points)};
  } else {
    layout.segments = layOutJoined(model, points);
  }
  for (size_t m = 0; m < layout.segments.size(); ++m) {
    layout.segments[m].edges = edgesOf(layout.segments[m], model.segments[m]);
  }
  layout.silhouette = silhouetteOf(model, layout.segments, points);
  return layout;
}

cv::Mat1b maskOf(const Silhouette& silhouette, const cv::Rect& region, double margin) {
  std::vector<cv::Point> points;
  for (const cv::Point2d& point : silhouette.points) {
    points.push_back(cv::Point(point) - region.tl());
  }
  cv::Mat1b mask(region.size(), uchar(0));
  if (silhouette.stroke > 0.0) {
    const double width = silhouette.stroke + 2.0 * margin;
    cv::polylines(mask, points, false, 255, std::max(1, cvRound(width)));
    return mask;
  }
  cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{points}, 255);
  if (margin > 0.0) cv::polylines(mask, points, true, 255, std::max(1, cvRound(2.0 * margin)));
  return mask;
}

}  // namespace chain_tracker
