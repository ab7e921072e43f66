// SPDX-License-Identifier: BSD-3-Clause
/// Chains of several segments, from layout to tracking.
#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/chain_tracker.h"
#include "chain_tracker/chain/object_shape.h"
#include "chain_tracker/image/pixel_geometry.h"
#include "support/drawn_arm.h"
#include "support/refusal.h"

namespace chain_tracker {
namespace {

ChainModel armModel(size_t links, Layout layout = Layout::kElongated) {
  ChainModel model;
  model.segments[0].parts = 12;
  model.segments[0].layout = layout;
  model.segments[0].aspect = DrawnArm::kWidth / DrawnArm::kLength;
  model.segments[0].name = "link";
  model.segment_per_edge = true;
  return forPolyline(model, links + 1);
}

TEST(ForPolyline, makesASegmentOfEveryEdge) {
  const ChainModel model = armModel(3);
  ASSERT_EQ(3U, model.segments.size());
  EXPECT_EQ("link1", model.segments[0].name);
  EXPECT_EQ("link3", model.segments[2].name);
  EXPECT_EQ(12, model.segments[2].parts);
  EXPECT_EQ(1U, forPolyline(ChainModel(), 5).segments.size());
}

TEST(LayOutJoined, putsEverySegmentBetweenItsVertices) {
  const std::vector<cv::Point2d> vertices = {{10, 20}, {90, 20}, {90, 80}, {130, 110}};
  for (Layout layout : {Layout::kElongated, Layout::kDeformable}) {
    const ChainLayout chain = layOut(armModel(3, layout), vertices);
    ASSERT_EQ(3U, chain.segments.size());
    for (size_t m = 0; m < 3; ++m) {
      SCOPED_TRACE("segment " + std::to_string(m));
      const SegmentLayout& segment = chain.segments[m];
      EXPECT_EQ(m > 0, segment.entry.has_value());
      EXPECT_EQ(m < 2, segment.exit.has_value());
      const auto placed = [&](const cv::Point2d& point) {
        return segment.image_from_segment.apply(point);
      };
      if (segment.entry) {
        EXPECT_LT(cv::norm(placed(*segment.entry) - vertices[m]), 1e-9);
      }
      if (segment.exit) {
        EXPECT_LT(cv::norm(placed(*segment.exit) - vertices[m + 1]), 1e-9);
      }
      EXPECT_NEAR(directionOf(vertices[m + 1] - vertices[m]), segment.image_from_segment.angle,
                  1e-9);
      // The parts lie symmetrically between the vertices.
      cv::Point2d mean;
      for (const PartLayout& part : segment.parts) {
        mean += placed(part.position) / double(segment.parts.size());
      }
      EXPECT_LT(cv::norm(mean - 0.5 * (vertices[m] + vertices[m + 1])), 1e-6);
      const std::vector<cv::Point2d> nodes = nodesOf(segment);
      ASSERT_EQ(nodes.size(), segment.edges.size() + 1);
      for (size_t k = 0; k < segment.edges.size(); ++k) {
        EXPECT_NEAR(cv::norm(nodes[k + 1] - nodes[k]), segment.edges[k].length, 1e-9);
        EXPECT_GT(segment.edges[k].length, 1.0) << "edge " << k << " has no direction";
      }
    }
  }
}

TEST(LayOutJoined, refusesAWrongNumberOfVertices) {
  const ChainModel model = armModel(2);
  const std::string refusal = refusalOf([&] {
    layOut(model, {{0, 0}, {50, 0}, {50, 50}, {0, 90}});
  });
  EXPECT_EQ("", omissionsOf(refusal, {"4 points", "3 vertices", "2 joined segments"}));
  EXPECT_EQ("", omissionsOf(refusalOf([&] {
                              layOut(model, {{0, 0}, {50, 0}, {50, 0}});
                            }),
                            {"points 1 and 2", "(50, 0)"}));
}

TEST(LayOutJoined, refusesAPolylineWithoutEdges) {
  ChainModel model;
  model.name = "insect";
  model.segment_per_edge = true;
  for (size_t count : {0U, 1U}) {
    const std::vector<cv::Point2d> points(count, cv::Point2d(30, 30));
    const std::string refusal = refusalOf([&] { layOut(forPolyline(model, count), points); });
    EXPECT_EQ("", omissionsOf(refusal, {"insect", std::to_string(count), "at least 2"}));
  }
}

TEST(ObjectShape, ofJoinedSegmentsAnswersForTheirVertices) {
  const std::vector<double> angles = {0.3, 1.2};
  const std::vector<cv::Point2d> vertices = DrawnArm::vertices({100, 60}, angles);
  const ChainTracker tracker(armModel(2), DrawnArm(2).image({100, 60}, angles), vertices);
  const ChainState& state = tracker.state();
  ASSERT_EQ(3U, state.points.size());
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_LT(cv::norm(state.points[i].position - vertices[i]), 1e-6) << "vertex " << i;
    EXPECT_TRUE(state.box.contains(vertices[i])) << "vertex " << i;
  }
  ASSERT_EQ(2U, state.segments.size());
  EXPECT_EQ(state.segments[0].part_count, state.segments[1].first_part);
  EXPECT_EQ(static_cast<size_t>(state.segments[1].first_part + state.segments[1].part_count),
            state.parts.size());
  EXPECT_NEAR(0.3, state.parts.front().orientation, 1e-9);
  EXPECT_NEAR(1.2, state.parts.back().orientation, 1e-9);
}

struct Motion {
  std::string name;
  double turns[3];  ///< of the links, each frame [rad]
};

/// Every link turns by itself, against its neighbours.
TEST(ChainTracker, articulatedModelFollowsEveryLink) {
  const DrawnArm arm(3);
  for (const Motion& motion :
       {Motion{"folding", {0.04, -0.05, 0.06}}, Motion{"waving", {0.0, 0.0, 0.12}},
        Motion{"together", {0.05, 0.05, 0.05}}}) {
    SCOPED_TRACE(motion.name);
    std::vector<double> angles = {0.4, -0.3, 0.3};
    cv::Point2d start(70, 110);
    ChainTracker tracker(armModel(3), arm.image(start, angles), DrawnArm::vertices(start, angles));
    for (int frame = 1; frame <= 12; ++frame) {
      for (size_t i = 0; i < 3; ++i) angles[i] += motion.turns[i];
      start += cv::Point2d(1.5, 0.7);
      const ChainState& state = tracker.update(arm.image(start, angles));
      ASSERT_NE(TrackingStatus::kLost, state.status) << "frame " << frame;
    }
    const ChainState& state = tracker.state();
    const std::vector<cv::Point2d> truth = DrawnArm::vertices(start, angles);
    for (size_t i = 0; i < truth.size(); ++i) {
      EXPECT_LT(cv::norm(state.points[i].position - truth[i]), 2.0) << "vertex " << i;
    }
    for (size_t i = 0; i < 3; ++i) {
      const double angle = state.segments[i].image_from_segment.angle;
      EXPECT_LT(std::abs(wrapAngle(angle - angles[i])), 0.1) << "beyond a step of the search";
    }
  }
}

TEST(ChainTracker, findsALinkThatTurnedWhileItWasHidden) {
  const cv::Point2d start(70.0, 150.0);
  std::vector<double> angles = {0.1, -0.3, 0.2};
  const DrawnArm arm(3);
  const DrawnArm without_tip(2);
  ChainTracker tracker(armModel(3), arm.image(start, angles), DrawnArm::vertices(start, angles));
  for (int frame = 0; frame < 12; ++frame) {
    angles[0] += 0.03;
    angles[1] -= 0.05;
    tracker.update(without_tip.image(start, angles));
  }
  EXPECT_EQ(TrackingStatus::kOccluded, tracker.state().status);
  angles[2] -= 2.2;
  for (int frame = 0; frame < 10; ++frame) tracker.update(arm.image(start, angles));
  EXPECT_EQ(TrackingStatus::kTracking, tracker.state().status);
  const std::vector<cv::Point2d> truth = DrawnArm::vertices(start, angles);
  for (size_t i = 0; i < truth.size(); ++i) {
    EXPECT_LT(cv::norm(tracker.state().points[i].position - truth[i]), 2.0) << "vertex " << i;
  }
}

/// Two links of one colour, of which the second seems half as long when its end is hidden.
TEST(ChainTracker, linksKeepTheirSizeWhileOneIsHidden) {
  const std::vector<cv::Point2d> vertices = {{60, 120}, {150, 120}, {150, 210}};
  cv::Mat3b image(260, 260, cv::Vec3b(60, 120, 40));
  for (size_t i = 0; i < 2; ++i) {
    cv::line(image, vertices[i], vertices[i + 1], cv::Scalar(40, 60, 200), 24);
  }
  ChainModel model = armModel(2);
  for (SegmentModel& segment : model.segments) {
    segment.scale_hypotheses = 1;
    segment.scale_step = 0.02;
  }
  ChainTracker tracker(model, image, vertices);
  image.rowRange(165, 260).setTo(cv::Vec3b(60, 120, 40));
  for (int frame = 0; frame < 15; ++frame) tracker.update(image);
  for (const SegmentState& segment : tracker.state().segments) {
    EXPECT_NEAR(1.0, segment.image_from_segment.scale, 0.1) << segment.name;
  }
}

TEST(ChainTracker, takesTheWidthOfLinksFromTheFirstImage) {
  cv::Mat3b image(240, 320, cv::Vec3b(60, 120, 40));
  image(cv::Rect(84, 50, 33, 160)).setTo(cv::Scalar(40, 60, 200));
  ChainModel model;
  model.segment_per_edge = true;
  model.segments[0].parts = 8;
  model.segments[0].measure_aspect = true;
  const ChainTracker tracker(model, image, {{100, 50}, {100, 130}, {100, 210}});
  EXPECT_NEAR(0.85 * 33.0 / 80.0, tracker.model().segments[1].aspect, 0.02);
}

TEST(ChainTracker, keepsTheAspectOfTheModelWhereMeasuredPartsWouldBeTooSmall) {
  cv::Mat3b image(240, 320, cv::Vec3b(60, 120, 40));
  image(cv::Rect(99, 100, 3, 40)).setTo(cv::Scalar(40, 60, 200));
  ChainModel model;
  model.segment_per_edge = true;
  model.segments[0].parts = 8;
  model.segments[0].aspect = 0.3;
  model.segments[0].margin = 0.0;
  model.segments[0].measure_aspect = true;
  const ChainTracker tracker(model, image, {{100, 100}, {100, 120}, {100, 140}});
  EXPECT_EQ(0.3, tracker.model().segments[0].aspect);
}

}  // namespace
}  // namespace chain_tracker
