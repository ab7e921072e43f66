// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/chain_tracker.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "chain_tracker/chain/auto_model.h"
#include "support/drawn_box.h"
#include "support/state_text.h"

namespace chain_tracker {
namespace {

/// What a point may be off after tracking [px].
constexpr double kFewPixels = 3.0;
/// The upright box covers whole pixels here, so that its drawing has no preferred direction.
const Similarity kStart{0.0, 1.0, {149.5, 109.5}};

ChainModel boxModel() {
  ChainModel model;
  model.segments[0].layout = Layout::kPlanar;
  model.segments[0].margin = 0.0;
  return model;
}

ChainTracker startTracker(const DrawnBox& box, const Similarity& start = kStart) {
  return ChainTracker(boxModel(), box.image(start), DrawnBox::corners(start));
}

double largestError(const ChainState& state, const Similarity& truth) {
  const std::vector<cv::Point2d> corners = DrawnBox::corners(truth);
  double largest = 0.0;
  for (size_t i = 0; i < corners.size(); ++i) {
    largest = std::max(largest, cv::norm(state.points[i].position - corners[i]));
  }
  return largest;
}

/// Tracks the box along the motion, given by its pose in each frame after the first.
template <typename Motion>
void expectTracked(const DrawnBox& box, int frames, const Motion& motion) {
  ChainTracker tracker = startTracker(box, motion(0));
  for (int frame = 1; frame <= frames; ++frame) {
    SCOPED_TRACE("frame " + std::to_string(frame));
    const ChainState& state = tracker.update(box.image(motion(frame)));
    ASSERT_EQ("TRACKING", toString(state.status));
    ASSERT_LT(largestError(state, motion(frame)), kFewPixels);
    ASSERT_NEAR(0.0, wrapAngle(state.segments[0].image_from_segment.angle - motion(frame).angle),
                0.06);
    ASSERT_NEAR(motion(frame).scale / motion(0).scale, state.segments[0].image_from_segment.scale,
                0.05);
  }
}

TEST(ChainTracker, startsWhereItIsTold) {
  const DrawnBox box;
  const ChainTracker tracker = startTracker(box);
  const ChainState& state = tracker.state();
  EXPECT_EQ(TrackingStatus::kInitializing, state.status);
  EXPECT_EQ(1.0, state.confidence);
  EXPECT_LT(largestError(state, kStart), 1e-9);
  EXPECT_EQ(4U, state.outline.size());
  EXPECT_NEAR(101.5, state.box.x, 1e-9);
  EXPECT_NEAR(79.5, state.box.y, 1e-9);
  EXPECT_NEAR(96.0, state.box.width, 1e-9);
  EXPECT_NEAR(60.0, state.box.height, 1e-9);
  EXPECT_EQ("bottle", tracker.model().name);
}

/// 12 by 8 pixels.
TEST(ChainTracker, followsASmallBox) {
  const DrawnBox box;
  const auto motion = [](int frame) {
    return Similarity{0.0, 0.125, {60.0 + 3.0 * frame, 100.0 + 20.0 * std::sin(0.2 * frame)}};
  };
  const std::vector<cv::Point2d> start = DrawnBox::corners(motion(0));
  ChainTracker tracker(withRoomForParts(boxModel(), start), box.image(motion(0)), start);
  for (int frame = 1; frame <= 60; ++frame) {
    SCOPED_TRACE("frame " + std::to_string(frame));
    const ChainState& state = tracker.update(box.image(motion(frame)));
    ASSERT_NE(TrackingStatus::kLost, state.status);
    ASSERT_LT(largestError(state, motion(frame)), 1.0);
  }
}

/// Down to half as bright, and from bluish to reddish light.
TEST(ChainTracker, followsABoxInChangingLight) {
  const DrawnBox box;
  for (const cv::Vec3d& last : {cv::Vec3d(0.55, 0.55, 0.55), cv::Vec3d(0.6, 0.9, 1.2)}) {
    SCOPED_TRACE(last);
    ChainTracker tracker = startTracker(box);
    for (int frame = 1; frame <= 60; ++frame) {
      SCOPED_TRACE("frame " + std::to_string(frame));
      const Similarity motion{0.0, 1.0, kStart.translation + cv::Point2d(0.5 * frame, 0.2 * frame)};
      cv::Mat lit;
      const cv::Vec3d light = cv::Vec3d::all(1.0) + frame / 60.0 * (last - cv::Vec3d::all(1.0));
      cv::multiply(box.image(motion), cv::Scalar(light[0], light[1], light[2]), lit);
      const ChainState& state = tracker.update(lit);
      ASSERT_EQ("TRACKING", toString(state.status));
      ASSERT_LT(largestError(state, motion), kFewPixels);
      ASSERT_GT(state.confidence, 0.7);
    }
  }
}

TEST(ChainTracker, followsABoxWhileALampIsSwitched) {
  const DrawnBox box;
  ChainTracker tracker = startTracker(box);
  for (int frame = 1; frame <= 60; ++frame) {
    const double light = frame / 10 % 2 == 0 ? 1.0 : 0.55;
    const Similarity motion{0.0, 1.0, kStart.translation + cv::Point2d(frame, 0.5 * frame)};
    const ChainState& state = tracker.update(light * box.image(motion));
    EXPECT_EQ(TrackingStatus::kTracking, state.status) << "frame " << frame;
    EXPECT_GT(state.confidence, 0.8) << "frame " << frame;
  }
}

/// Half of it is outside at first, on each side in turn.
TEST(ChainTracker, followsABoxThatComesInOverTheBorder) {
  const DrawnBox box;
  const cv::Point2d middle(159.5, 119.5);
  for (const cv::Point2d& edge : {cv::Point2d(5.5, 119.5), cv::Point2d(314.5, 119.5),
                                  cv::Point2d(159.5, 5.5), cv::Point2d(159.5, 234.5)}) {
    SCOPED_TRACE(edge);
    expectTracked(box, 30, [&](int frame) {
      return Similarity{0.0, 1.0, edge + frame / 30.0 * (middle - edge)};
    });
  }
}

/// Whatever part of a pixel the points fall on: the same image again must give the same positions.
TEST(ChainTracker, staysOnABoxAtRest) {
  const DrawnBox box;
  const cv::Mat image = box.image(kStart);
  for (double phase : {0.0, 0.25, 0.5, 0.75}) {
    SCOPED_TRACE("points moved by " + std::to_string(phase) + " px");
    const Similarity start{0.0, 1.0, kStart.translation + cv::Point2d(phase, phase)};
    ChainTracker tracker(boxModel(), image, DrawnBox::corners(start));
    for (int frame = 0; frame < 5; ++frame) tracker.update(image);
    const Similarity& pose = tracker.state().segments[0].image_from_segment;
    EXPECT_NEAR(start.translation.x, pose.translation.x, 0.3);
    EXPECT_NEAR(start.translation.y, pose.translation.y, 0.3);
    EXPECT_NEAR(0.0, pose.angle, 0.005);
    EXPECT_NEAR(1.0, pose.scale, 0.005);
    EXPECT_GT(tracker.state().confidence, 0.8);
  }
}

TEST(ChainTracker, followsShifts) {
  for (const cv::Point2d& velocity :
       {cv::Point2d(4, 0), cv::Point2d(-3.3, 2.6), cv::Point2d(0, 1)}) {
    expectTracked(DrawnBox(), 12, [&](int frame) {
      return Similarity{0.0, 1.0, kStart.translation + frame * velocity};
    });
  }
}

TEST(ChainTracker, followsJumpsWithinItsReach) {
  // The reach is 0.06 of a diagonal of 400 px.
  expectTracked(DrawnBox(), 6, [](int frame) {
    return Similarity{0.0, 1.0, kStart.translation + cv::Point2d(frame % 2 * 20, frame % 3 * 8)};
  });
}

TEST(ChainTracker, followsTurns) {
  for (double turn : {0.05, -0.12}) {
    expectTracked(DrawnBox(), 20, [&](int frame) {
      return Similarity{wrapAngle(frame * turn), 1.0, kStart.translation};
    });
  }
}

TEST(ChainTracker, followsScales) {
  for (double growth : {0.02, -0.02}) {
    expectTracked(DrawnBox(), 15, [&](int frame) {
      return Similarity{0.0, std::exp(frame * growth), kStart.translation};
    });
  }
}

TEST(ChainTracker, followsAllAtOnceFromATurnedStart) {
  expectTracked(DrawnBox(), 15, [](int frame) {
    return Similarity{2.9 + 0.06 * frame, std::exp(-0.01 * frame),
                      kStart.translation + frame * cv::Point2d(2.5, 1.5)};
  });
}

TEST(ChainTracker, followsInGreyImages) {
  expectTracked(DrawnBox(CV_8UC1), 12, [](int frame) {
    return Similarity{0.05 * frame, 1.0, kStart.translation + frame * cv::Point2d(3, -1)};
  });
}

TEST(ChainTracker, elongatedModelFollowsTwoEnds) {
  const DrawnBox box;
  ChainModel model;
  model.segments[0].aspect = DrawnBox::kWidth / DrawnBox::kLength;
  const auto ends = [](const Similarity& pose) {
    return std::vector<cv::Point2d>{pose.apply({-48, 0}), pose.apply({48, 0})};
  };
  ChainTracker tracker(model, box.image(kStart), ends(kStart));
  Similarity pose = kStart;
  for (int frame = 1; frame <= 10; ++frame) {
    pose = {0.05 * frame, 1.0, kStart.translation + frame * cv::Point2d(3, 2)};
    tracker.update(box.image(pose));
  }
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_LT(cv::norm(tracker.state().points[i].position - ends(pose)[i]), kFewPixels);
  }
}

TEST(ChainTracker, deformableModelFollowsAPolyline) {
  const DrawnBox box;
  ChainModel model;
  SegmentModel& segment = model.segments[0];
  segment.layout = Layout::kDeformable;
  segment.parts = 9;
  segment.bend_sigma = 0.3;
  segment.orientation_hypotheses = segment.scale_hypotheses = 1;
  const std::vector<cv::Point2d> line = {{-40, -20}, {0, 10}, {40, -10}};
  const auto placed = [&](const Similarity& pose) {
    std::vector<cv::Point2d> points = line;
    for (cv::Point2d& point : points) point = pose.apply(point);
    return points;
  };
  ChainTracker tracker(model, box.image(kStart), placed(kStart));
  Similarity pose = kStart;
  for (int frame = 1; frame <= 10; ++frame) {
    pose = {0.04 * frame, 1.0, kStart.translation + frame * cv::Point2d(2, -3)};
    ASSERT_NE(TrackingStatus::kLost, tracker.update(box.image(pose)).status);
  }
  for (size_t i = 0; i < line.size(); ++i) {
    EXPECT_LT(cv::norm(tracker.state().points[i].position - placed(pose)[i]), kFewPixels);
  }
}

/// Where one pose is searched, its steps are the most that the fit may turn and rescale in a frame.
TEST(ChainTracker, singlePoseTurnsAndRescalesByOneStepAtMost) {
  const DrawnBox box;
  ChainModel model;
  SegmentModel& segment = model.segments[0];
  segment.layout = Layout::kDeformable;
  segment.parts = 9;
  segment.bend_sigma = 0.3;
  segment.orientation_hypotheses = segment.scale_hypotheses = 1;
  segment.orientation_step = 0.02;
  segment.scale_step = 0.01;
  model.appearance.outlier_slope = 1.0;
  model.search.doubt_below = model.search.travel_weight = 0.0;
  const std::vector<cv::Point2d> line = {kStart.apply({-40, 0}), kStart.apply({40, 0})};
  for (double change : {0.1, -0.1}) {
    ChainTracker tracker(model, box.image(kStart), line);
    const Similarity pose{change, std::exp(change), kStart.translation};
    const ChainState& state = tracker.update(box.image(pose));
    ASSERT_NE(TrackingStatus::kLost, state.status);
    const Similarity& found = state.segments[0].image_from_segment;
    EXPECT_NEAR(change > 0.0 ? 0.02 : -0.02, found.angle, 1e-9);
    EXPECT_NEAR(change > 0.0 ? 0.01 : -0.01, std::log(found.scale), 1e-9);
  }
}

TEST(ChainTracker, sameInputGivesTheSameStates) {
  const DrawnBox box;
  ChainTracker first = startTracker(box);
  ChainTracker second = startTracker(box);
  EXPECT_EQ(textOf(first.state()), textOf(second.state()));
  for (int frame = 1; frame <= 6; ++frame) {
    const cv::Mat image =
        box.image({0.07 * frame, 1.0, kStart.translation + frame * cv::Point2d(4, 3)});
    const std::string state = textOf(first.update(image));
    EXPECT_EQ(state, textOf(second.update(image)));
    EXPECT_EQ(state, textOf(first.state())) << "state() is not what update() returned";
  }
}

TEST(ChainTracker, doesNotKeepOrChangeTheImage) {
  const DrawnBox box;
  cv::Mat image = box.image(kStart);
  ChainTracker tracker(boxModel(), image, DrawnBox::corners(kStart));
  ChainTracker twin = startTracker(box);
  image.setTo(0);
  cv::Mat next = box.image(kStart);
  const cv::Mat untouched = next.clone();
  EXPECT_EQ(textOf(twin.update(untouched)), textOf(tracker.update(next)));
  EXPECT_EQ(0.0, cv::norm(untouched, next, cv::NORM_INF));
}

TEST(ChainTracker, stateIsWithinItsRanges) {
  const DrawnBox box;
  ChainTracker tracker = startTracker(box);
  const ChainState& state = tracker.update(box.image({0.1, 1.03, {154.5, 111.5}}));
  ASSERT_EQ(1U, state.segments.size());
  const SegmentState& segment = state.segments[0];
  EXPECT_EQ("body", segment.name);
  EXPECT_EQ(0, segment.first_part);
  EXPECT_EQ(static_cast<int>(state.parts.size()), segment.part_count);
  double least = 1.0;
  double most = 0.0;
  for (const PartState& part : state.parts) {
    EXPECT_GE(part.confidence, 0.0);
    EXPECT_LE(part.confidence, 1.0);
    EXPECT_TRUE(part.visible);
    EXPECT_EQ(segment.image_from_segment.angle, part.orientation);
    EXPECT_NEAR(tracker.state().parts[0].side, part.side, 1e-9);
    least = std::min(least, part.confidence);
    most = std::max(most, part.confidence);
  }
  EXPECT_GE(state.confidence, least);
  EXPECT_LE(state.confidence, most);
  EXPECT_EQ(state.confidence, segment.confidence);
}

TEST(ChainTracker, covariancesOfAWellSeenBoxArePositiveDefinite) {
  const DrawnBox box;
  ChainTracker tracker = startTracker(box);
  for (const PartState& part : tracker.update(box.image({0.0, 1.0, {152.5, 111.5}})).parts) {
    const cv::Matx22d& covariance = part.covariance;
    EXPECT_GT(covariance(0, 0), 0.0);
    EXPECT_GT(cv::determinant(covariance), 0.0);
    EXPECT_EQ(covariance(0, 1), covariance(1, 0));
    EXPECT_LT(covariance(0, 0) + covariance(1, 1), 400.0) << "at " << part.position;
  }
}

TEST(ChainTracker, isMovedWithItsState) {
  const DrawnBox box;
  ChainTracker original = startTracker(box);
  ChainTracker twin = startTracker(box);
  original.update(box.image(kStart));
  twin.update(box.image(kStart));
  ChainTracker moved(std::move(original));
  EXPECT_EQ(textOf(twin.state()), textOf(moved.state()));
  ChainTracker assigned = startTracker(box, {0.5, 1.0, {100, 100}});
  assigned = std::move(moved);
  const cv::Mat next = box.image({0.05, 1.0, {153.5, 107.5}});
  EXPECT_EQ(textOf(twin.update(next)), textOf(assigned.update(next)));
}

}  // namespace
}  // namespace chain_tracker
