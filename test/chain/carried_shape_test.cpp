// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/carried_shape.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "chain_tracker/chain/object_shape.h"

namespace chain_tracker {
namespace {

struct Shape {
  std::string name;
  Layout layout;
  std::vector<cv::Point2d> points;
};

std::vector<Shape> shapes() {
  return {{"two ends", Layout::kElongated, {{100, 60}, {160, 140}}},
          {"upright ends", Layout::kElongated, {{100, 60}, {100, 140}}},
          {"corners", Layout::kElongated, {{20, 20}, {60, 20}, {60, 110}, {20, 110}}},
          {"turned box", Layout::kPlanar, {{50, 20}, {90, 60}, {60, 90}, {20, 50}}},
          {"polyline", Layout::kDeformable, {{10, 10}, {70, 15}, {90, 60}, {50, 95}}},
          {"straight line", Layout::kDeformable, {{10, 50}, {120, 50}}},
          {"vertical line", Layout::kDeformable, {{40, 10}, {40, 120}}},
          {"closed line", Layout::kDeformable, {{10, 10}, {90, 10}, {90, 90}, {10, 10}}},
          {"doubled line", Layout::kDeformable, {{10, 10}, {90, 10}, {10, 10}}},
          {"points", Layout::kPoints, {{10, 20}, {80, 20}, {50, 40}, {80, 70}, {10, 70}}}};
}

SegmentLayout layOutShape(const Shape& shape) {
  ChainModel model;
  model.segments[0].layout = shape.layout;
  model.segments[0].parts = 10;
  return layOut(model, shape.points).segments.front();
}

/// Angle and scale add up and multiply; both turn about their own origins.
Similarity after(const Similarity& first, const Similarity& second) {
  return {first.angle + second.angle, first.scale * second.scale, second.apply(first.translation)};
}

struct Object {
  SegmentState segment;
  std::vector<PartState> parts;
};

/// The object as laid out, all of it moved.
Object moved(const SegmentLayout& layout, const Similarity& motion) {
  Object object;
  object.segment.image_from_segment = after(layout.image_from_segment, motion);
  for (const PartLayout& part : layout.parts) {
    PartState state;
    state.position = object.segment.image_from_segment.apply(part.position);
    state.confidence = 1.0;
    state.visible = true;
    object.parts.push_back(state);
  }
  return object;
}

std::vector<CarriedPoint> pointsOf(const CarriedShape& carried, const Object& object) {
  std::vector<CarriedPoint> points;
  carried.addPoints(object.segment, object.parts, points);
  return points;
}

std::vector<cv::Point2d> outlineOf(const CarriedShape& carried, const Object& object) {
  std::vector<cv::Point2d> outline;
  carried.addOutline(object.segment, object.parts, outline);
  return outline;
}

cv::Rect2d boxOf(const CarriedShape& carried, const Object& object) {
  return carried.box(object.segment, outlineOf(carried, object));
}

std::vector<double> orientationsOf(const SegmentLayout& layout, const Object& object) {
  std::vector<double> orientations;
  for (size_t k = 0; k < object.parts.size(); ++k) {
    orientations.push_back(partOrientation(layout, object.segment, object.parts, k));
  }
  return orientations;
}

void expectNear(const cv::Point2d& expected, const cv::Point2d& actual, const std::string& what) {
  EXPECT_NEAR(expected.x, actual.x, 1e-6) << what;
  EXPECT_NEAR(expected.y, actual.y, 1e-6) << what;
}

void expectNear(const cv::Rect2d& expected, const cv::Rect2d& actual) {
  expectNear(expected.tl(), actual.tl(), "top left corner");
  expectNear(expected.br(), actual.br(), "bottom right corner");
}

TEST(CarriedShape, pointsAreThoseGivenAndMoveWithTheObject) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    const SegmentLayout layout = layOutShape(shape);
    const CarriedShape carried(layout);
    for (const Similarity& motion :
         {Similarity(), Similarity{0.3, 1.2, {15, -8}}, Similarity{-2.8, 0.5, {200, 40}}}) {
      const Object object = moved(layout, motion);
      const std::vector<CarriedPoint> points = pointsOf(carried, object);
      ASSERT_EQ(shape.points.size(), points.size());
      for (size_t i = 0; i < points.size(); ++i) {
        expectNear(motion.apply(shape.points[i]), points[i].position, "point " + std::to_string(i));
        EXPECT_TRUE(points[i].visible);
        EXPECT_EQ(1.0, points[i].confidence);
      }
    }
  }
}

TEST(CarriedShape, outlineTurnsAndGrowsWithTheObject) {
  for (const Shape& shape : shapes()) {
    if (shape.layout == Layout::kDeformable) continue;
    SCOPED_TRACE(shape.name);
    const SegmentLayout layout = layOutShape(shape);
    const CarriedShape carried(layout);
    const Similarity motion{0.7, 1.5, {3, 4}};
    const Object object = moved(layout, Similarity());
    const Object turned = moved(layout, motion);
    const auto at_first = outlineOf(carried, object);
    const auto later = outlineOf(carried, turned);
    ASSERT_EQ(4U, at_first.size());
    ASSERT_EQ(4U, later.size());
    for (size_t i = 0; i < 4; ++i) {
      expectNear(motion.apply(at_first[i]), later[i], "corner " + std::to_string(i));
    }
  }
}

TEST(CarriedShape, boxBoundsTheShapeAtFirst) {
  for (const Shape& shape : shapes()) {
    if (shape.points.size() == 2 && shape.layout == Layout::kElongated) continue;
    SCOPED_TRACE(shape.name);
    const SegmentLayout layout = layOutShape(shape);
    const Object object = moved(layout, Similarity());
    expectNear(uprightBounds(shape.points), boxOf(CarriedShape(layout), object));
  }
}

TEST(CarriedShape, uprightBoxMovesAndGrowsButDoesNotTurn) {
  // Each of these has an upright initial box, of this size.
  for (const Shape& shape :
       {shapes()[2],
        Shape{"planar", Layout::kPlanar, {{60, 110}, {20, 110}, {20, 20}, {60, 20}}}}) {
    SCOPED_TRACE(shape.name);
    const SegmentLayout layout = layOutShape(shape);
    const CarriedShape carried(layout);
    Object object = moved(layout, Similarity());
    const cv::Point2d center = object.segment.image_from_segment.translation;
    for (double angle : {0.0, 0.4, 1.5, -3.0}) {
      object.segment.image_from_segment = {layout.image_from_segment.angle + angle, 2.0,
                                           center + cv::Point2d(7, 9)};
      // All about the segment's centre.
      const cv::Point2d low = center + 2.0 * (cv::Point2d(20, 20) - center) + cv::Point2d(7, 9);
      expectNear(cv::Rect2d(low, cv::Size2d(80, 180)), boxOf(carried, object));
    }
  }
}

TEST(CarriedShape, turnedBoxAndPointsAreBoundedAnewAsTheyTurn) {
  for (const Shape& shape : {shapes()[3], shapes().back()}) {
    SCOPED_TRACE(shape.name);
    const SegmentLayout layout = layOutShape(shape);
    const CarriedShape carried(layout);
    for (double angle : {0.0, 0.4, CV_PI / 4.0, -3.0}) {
      const Object object = moved(layout, {angle, 1.5, {7, 9}});
      std::vector<cv::Point2d> corners;
      for (const cv::Point2d& corner : shape.points) {
        corners.push_back(Similarity{angle, 1.5, {7, 9}}.apply(corner));
      }
      expectNear(uprightBounds(corners), boxOf(carried, object));
    }
  }
}

TEST(CarriedShape, boxOfTwoEndsTurnsHoweverTheyLieAtFirst) {
  for (const Shape& shape : {shapes()[0], shapes()[1]}) {
    SCOPED_TRACE(shape.name);
    const SegmentLayout layout = layOutShape(shape);
    const CarriedShape carried(layout);
    const Object object = moved(layout, {1.0, 1.5, {7, 9}});
    const cv::Rect2d box = boxOf(carried, object);
    expectNear(uprightBounds(outlineOf(carried, object)), box);
    for (const CarriedPoint& end : pointsOf(carried, object)) {
      EXPECT_TRUE(box.contains(end.position)) << end.position;
    }
  }
}

/// A line of three parts at 0, 20 and 40, given by five points.
struct Line {
  SegmentLayout layout;
  Object object;

  Line() {
    ChainModel model;
    model.segments[0].layout = Layout::kDeformable;
    model.segments[0].parts = 3;
    layout = layOut(model, {{0, 0}, {10, 0}, {20, 0}, {30, 0}, {40, 0}}).segments.front();
    object = moved(layout, Similarity());
  }
  std::vector<CarriedPoint> points() const { return pointsOf(CarriedShape(layout), object); }
};

TEST(ObjectShape, outlineOfADeformableObjectIsAroundItAsItIs) {
  Line line;
  line.object.parts[2].position = {20, 30};
  ChainState state;
  state.parts = line.object.parts;
  state.segments = {line.object.segment};
  ObjectShape({line.layout}).carry(state);
  EXPECT_EQ(3U, state.outline.size());
  expectNear(cv::Rect2d(0, 0, 20, 30), state.box);
}

TEST(CarriedShape, pointsOfADeformableObjectFollowTheirEdge) {
  Line line;
  line.object.parts[2].position = {20, 30};  // The second half turns by 90 degrees and stretches.
  const std::vector<CarriedPoint> points = line.points();
  expectNear({0, 0}, points[0].position, "point 0");
  expectNear({10, 0}, points[1].position, "point 1");
  expectNear({20, 0}, points[2].position, "point 2");
  expectNear({20, 15}, points[3].position, "point 3");
  expectNear({20, 30}, points[4].position, "point 4");
}

TEST(CarriedShape, pointsOfADeformableObjectAreSeenWithBothEndsOfTheirEdge) {
  Line line;
  line.object.parts[2].visible = false;
  line.object.parts[2].confidence = 0.2;
  const std::vector<CarriedPoint> points = line.points();
  EXPECT_TRUE(points[1].visible);
  EXPECT_EQ(1.0, points[1].confidence);
  EXPECT_FALSE(points[3].visible);
  EXPECT_NEAR(0.6, points[3].confidence, 1e-12);
}

TEST(CarriedShape, pointsOfACollapsedEdgeStayFinite) {
  Line line;
  line.object.parts[2].position = line.object.parts[1].position;
  for (const CarriedPoint& point : line.points()) {
    EXPECT_LE(cv::norm(point.position), 100.0) << point.position;
  }
}

TEST(CarriedShape, pointsOfARigidObjectAreSeenWithTheNearestPart) {
  const Shape shape = shapes()[2];
  const SegmentLayout layout = layOutShape(shape);
  Object object = moved(layout, Similarity());
  size_t nearest = 0;
  for (size_t k = 0; k < object.parts.size(); ++k) {
    const auto distance = [&](size_t i) {
      return cv::norm(object.parts[i].position - shape.points[2]);
    };
    if (distance(k) < distance(nearest)) nearest = k;
  }
  object.parts[nearest].visible = false;
  object.parts[nearest].confidence = 0.1;
  const auto points = pointsOf(CarriedShape(layout), object);
  EXPECT_FALSE(points[2].visible);
  EXPECT_EQ(0.1, points[2].confidence);
  for (size_t i : {0U, 1U, 3U}) EXPECT_TRUE(points[i].visible) << "point " << i;
}

TEST(PartOrientation, areTheSegmentsOnARigidLayout) {
  const SegmentLayout layout = layOutShape(shapes()[3]);
  const Object object = moved(layout, {0.3, 1.0, {0, 0}});
  const double angle = object.segment.image_from_segment.angle;
  for (double orientation : orientationsOf(layout, object)) {
    EXPECT_EQ(angle, orientation);
  }
}

TEST(PartOrientation, followADeformableChain) {
  Line line;
  line.object.parts[2].position = {20, 20};
  const auto angles = orientationsOf(line.layout, line.object);
  ASSERT_EQ(3U, angles.size());
  EXPECT_NEAR(0.0, angles[0], 1e-9);
  EXPECT_NEAR(CV_PI / 4.0, angles[1], 1e-9);
  EXPECT_NEAR(CV_PI / 2.0, angles[2], 1e-9);
}

}  // namespace
}  // namespace chain_tracker
