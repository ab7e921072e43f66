// SPDX-License-Identifier: BSD-3-Clause
/// What the tracker does when it cannot see the object, or not all of it.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "chain_tracker/chain/chain_model_io.h"
#include "chain_tracker/chain/chain_tracker.h"
#include "chain_tracker/evaluation/synthetic_scene.h"
#include "support/drawn_box.h"
#include "support/state_text.h"

namespace chain_tracker {
namespace {

const Similarity kStart{0.0, 1.0, {129.5, 109.5}};

ChainTracker startTracker(const DrawnBox& box) {
  ChainModel model;
  model.segments[0].layout = Layout::kPlanar;
  return ChainTracker(model, box.image(kStart), DrawnBox::corners(kStart));
}

ChainModel shippedModel(const std::string& name) {
  return loadChainModel(std::string(CHAIN_TRACKER_SOURCE_DIR) + "/config/models/" + name + ".yaml");
}

double largestError(const ChainState& state, const Similarity& truth) {
  const std::vector<cv::Point2d> corners = DrawnBox::corners(truth);
  double largest = 0.0;
  for (size_t i = 0; i < corners.size(); ++i) {
    largest = std::max(largest, cv::norm(state.points[i].position - corners[i]));
  }
  return largest;
}

/// Frames until the status is reached; fails after `most`.
int framesUntil(ChainTracker& tracker, const cv::Mat& image, TrackingStatus status, int most) {
  for (int frame = 1; frame <= most; ++frame) {
    if (tracker.update(image).status == status) return frame;
  }
  ADD_FAILURE() << "not " << toString(status) << " after " << most << " frames, but "
                << toString(tracker.state().status) << " with confidence "
                << tracker.state().confidence;
  return most;
}

TEST(ChainTrackerLoss, boxPaintedAwayIsLostAndStaysWhereItWas) {
  const DrawnBox box;
  ChainTracker tracker = startTracker(box);
  const Similarity last{0.05, 1.0, {133.5, 111.5}};
  tracker.update(box.image(last));
  const ChainState before = tracker.state();
  ASSERT_EQ(1, framesUntil(tracker, box.background(), TrackingStatus::kLost, 1));
  for (int frame = 0; frame < 4; ++frame) {
    const ChainState& state = tracker.update(box.background());
    EXPECT_EQ("LOST", toString(state.status));
    EXPECT_LT(state.confidence, 0.4);
    EXPECT_EQ(before.box, state.box);
    EXPECT_EQ(0.0, state.segments.front().confidence);
    for (size_t k = 0; k < state.parts.size(); ++k) {
      EXPECT_EQ(before.parts[k].position, state.parts[k].position) << "part " << k;
      EXPECT_EQ(0.0, state.parts[k].confidence) << "part " << k;
      EXPECT_FALSE(state.parts[k].visible) << "part " << k;
    }
    for (size_t i = 0; i < state.points.size(); ++i) {
      EXPECT_EQ(before.points[i].position, state.points[i].position) << "point " << i;
      EXPECT_EQ(0.0, state.points[i].confidence) << "point " << i;
    }
  }
}

TEST(ChainTrackerLoss, boxShownAgainWhereItWasIsTracked) {
  const DrawnBox box;
  ChainTracker tracker = startTracker(box);
  for (int frame = 0; frame < 3; ++frame) tracker.update(box.background());
  ASSERT_EQ(TrackingStatus::kLost, tracker.state().status);
  framesUntil(tracker, box.image(kStart), TrackingStatus::kTracking, 2);
  tracker.update(box.image(kStart));
  EXPECT_LT(largestError(tracker.state(), kStart), 3.0);
}

TEST(ChainTrackerLoss, boxShownAgainElsewhereIsFound) {
  const DrawnBox box;
  for (const cv::Point2d& away :
       {cv::Point2d(60, 0), cv::Point2d(100, 60), cv::Point2d(-50, -60)}) {
    SCOPED_TRACE(std::to_string(away.x) + ", " + std::to_string(away.y) + " px away");
    const Similarity there{0.0, 1.0, kStart.translation + away};
    ChainTracker tracker = startTracker(box);
    for (int frame = 0; frame < 6; ++frame) tracker.update(box.background());
    ASSERT_EQ(TrackingStatus::kLost, tracker.state().status);
    framesUntil(tracker, box.image(there), TrackingStatus::kTracking, 3);
    for (int frame = 0; frame < 3; ++frame) tracker.update(box.image(there));
    EXPECT_LT(largestError(tracker.state(), there), 3.0);
  }
}

/// While nothing is seen of the object, nothing tells that its light is as at first again.
TEST(ChainTrackerLoss, boxShownAgainInTheLightOfTheFirstFrameIsFound) {
  const DrawnBox box;
  ChainTracker tracker = startTracker(box);
  double light = 1.0;
  for (int frame = 0; frame < 40; ++frame) {
    light = std::max(0.5, light - 0.02);
    tracker.update(light * box.image(kStart));
  }
  ASSERT_EQ(TrackingStatus::kTracking, tracker.state().status);
  for (int frame = 0; frame < 6; ++frame) tracker.update(light * box.background());
  ASSERT_EQ(TrackingStatus::kLost, tracker.state().status);
  framesUntil(tracker, box.image(kStart), TrackingStatus::kTracking, 4);
  // It is followed in that light.
  for (int frame = 0; frame < 10; ++frame) tracker.update(box.image(kStart));
  EXPECT_GT(tracker.state().confidence, 0.9);
  EXPECT_LT(largestError(tracker.state(), kStart), 3.0);
}

/// The box in one of three images side by side, or in none of them.
cv::Mat wideImage(const DrawnBox& box, int place) {
  std::vector<cv::Mat> images(3, box.background());
  if (place >= 0) images.at(static_cast<size_t>(place)) = box.image(kStart);
  cv::Mat wide;
  cv::hconcat(images, wide);
  return wide;
}

/// The box blurs more and more. Then most of another one that looks as it did comes into sight.
TEST(ChainTrackerLoss, whatChangesItsLookStaysWhereItIs) {
  const DrawnBox box;
  ChainTracker tracker = startTracker(box);
  cv::Mat image;
  for (int frame = 1; frame <= 30; ++frame) {
    cv::Mat blurred;
    cv::blur(box.image(kStart), blurred, {45, 45});
    const double share = 0.8 * frame / 30.0;
    image = (1.0 - share) * box.image(kStart) + share * blurred;
    tracker.update(image);
  }
  const Similarity there{0.0, 1.0, kStart.translation + cv::Point2d(100.0, 60.0)};
  const cv::Rect most(cv::Point(DrawnBox::corners(there)[0]),
                      cv::Size2d(0.8 * DrawnBox::kLength, DrawnBox::kWidth));
  box.image(there)(most).copyTo(image(most));
  for (int frame = 1; frame <= 20; ++frame) {
    const ChainState& state = tracker.update(image);
    ASSERT_NE(TrackingStatus::kLost, state.status);
    ASSERT_LT(largestError(state, kStart), 10.0) << "after " << frame << " frames";
  }
}

TEST(ChainTrackerLoss, boxShownAgainAtTheOtherEndOfTheImageIsFound) {
  const DrawnBox box;
  for (const auto& [from, to] : {std::pair(0, 2), std::pair(2, 0)}) {
    SCOPED_TRACE(to);
    const auto at = [](int place) {
      return Similarity{0.0, 1.0,
                        kStart.translation + cv::Point2d(place * DrawnBox::kImageWidth, 0.0)};
    };
    ChainModel model;
    model.segments[0].layout = Layout::kPlanar;
    ChainTracker tracker(model, wideImage(box, from), DrawnBox::corners(at(from)));
    for (int frame = 0; frame < 8; ++frame) tracker.update(wideImage(box, -1));
    ASSERT_EQ(TrackingStatus::kLost, tracker.state().status);
    framesUntil(tracker, wideImage(box, to), TrackingStatus::kTracking, 4);
    for (int frame = 0; frame < 3; ++frame) tracker.update(wideImage(box, to));
    EXPECT_LT(largestError(tracker.state(), at(to)), 3.0);
  }
}

/// Every other frame looks at all orientations.
TEST(ChainTrackerLoss, boxShownAgainTurnedIsFound) {
  const DrawnBox box;
  for (const double turn : {1.0, -1.6, 3.1}) {
    SCOPED_TRACE(std::to_string(turn) + " rad");
    const Similarity there{turn, 1.0, kStart.translation + cv::Point2d(20, -10)};
    ChainTracker tracker = startTracker(box);
    for (int frame = 0; frame < 3; ++frame) tracker.update(box.background());
    ASSERT_EQ(TrackingStatus::kLost, tracker.state().status);
    framesUntil(tracker, box.image(there), TrackingStatus::kTracking, 3);
    for (int frame = 0; frame < 6; ++frame) tracker.update(box.image(there));
    EXPECT_LT(largestError(tracker.state(), there), 3.0);
  }
}

TEST(ChainTrackerLoss, hypothesesMayCoverAllOrientations) {
  const DrawnBox box;
  ChainModel model;
  model.segments[0].layout = Layout::kPlanar;
  model.segments[0].orientation_hypotheses = 7;
  model.segments[0].orientation_step = 1.0;
  ChainTracker tracker(model, box.image(kStart), DrawnBox::corners(kStart));
  for (int frame = 0; frame < 5; ++frame) tracker.update(box.background());
  EXPECT_EQ("LOST", toString(tracker.state().status));
  framesUntil(tracker, box.image(kStart), TrackingStatus::kTracking, 3);
}

TEST(ChainTrackerLoss, searchGoesFartherWithEveryFrame) {
  const DrawnBox box;
  const Similarity there{0.0, 1.0, kStart.translation + cv::Point2d(130, 0)};
  ChainTracker tracker = startTracker(box);
  // Beyond the reach of 24 px and, after one frame, of 96.
  tracker.update(box.image(there));
  EXPECT_EQ(TrackingStatus::kLost, tracker.state().status);
  tracker.update(box.image(there));
  EXPECT_EQ(TrackingStatus::kLost, tracker.state().status);
  framesUntil(tracker, box.image(there), TrackingStatus::kTracking, 4);
  EXPECT_LT(largestError(tracker.state(), there), 5.0);
}

/// The left third is covered; the parts there are carried by the others.
TEST(ChainTrackerLoss, coveredPartsAreHiddenAndCarried) {
  const DrawnBox box;
  ChainTracker tracker = startTracker(box);
  for (int frame = 1; frame <= 8; ++frame) {
    SCOPED_TRACE("frame " + std::to_string(frame));
    const Similarity pose{0.0, 1.0, kStart.translation + frame * cv::Point2d(3, 1)};
    cv::Mat image = box.image(pose);
    const double edge = pose.translation.x - DrawnBox::kLength / 6;
    const cv::Rect covered(0, 0, static_cast<int>(edge), image.rows);
    box.background()(covered).copyTo(image(covered));
    const ChainState& state = tracker.update(image);
    ASSERT_EQ("OCCLUDED", toString(state.status));
    int hidden = 0;
    for (const PartState& part : state.parts) {
      if (part.position.x < edge - 12.0) {
        EXPECT_FALSE(part.visible) << "at " << part.position;
      }
      if (part.position.x > edge + 20.0) {
        EXPECT_TRUE(part.visible) << "at " << part.position;
      }
      hidden += part.visible ? 0 : 1;
    }
    EXPECT_GT(hidden, 0);
    ASSERT_LT(largestError(state, pose), 6.0);
  }
  const Similarity last{0.0, 1.0, kStart.translation + cv::Point2d(24, 8)};
  EXPECT_EQ("TRACKING", toString(tracker.update(box.image(last)).status));
}

ChainTracker startTracker(const SyntheticScene& scene) {
  const SceneFrame first = scene.render(0);
  return ChainTracker(shippedModel(scene.model()), first.image, first.points);
}

/// What is left looks a little like some of them.
TEST(ChainTrackerLoss, whatVanishesIsLost) {
  for (const std::string name : {"bottle", "box", "robot_arm", "cable"}) {
    SCOPED_TRACE(name);
    const auto scene = makeScene(name, SceneOptions());
    ChainTracker tracker = startTracker(*scene);
    for (int index = 1; index <= 20; ++index) tracker.update(scene->render(index).image);
    ASSERT_NE(TrackingStatus::kLost, tracker.state().status);
    int lost = 0;
    for (int index = 21; index <= 40; ++index) {
      const ChainState& state = tracker.update(scene->renderWithoutObject(index));
      lost += state.status == TrackingStatus::kLost ? 1 : 0;
    }
    EXPECT_GE(lost, 18) << "of 20 frames without it";
    framesUntil(tracker, scene->render(41).image, TrackingStatus::kTracking, 10);
  }
}

/// In doubt, lost and found again: what takes long enough to be shared out.
TEST(ChainTrackerLoss, threadsChangeNothing) {
  for (const std::string name : {"box", "robot_arm", "cable"}) {
    SCOPED_TRACE(name);
    const auto scene = makeScene(name, SceneOptions());
    ChainTracker alone = startTracker(*scene);
    ChainTracker together = startTracker(*scene);
    together.useThreads(3);
    int lost = 0;
    for (int index = 1; index <= 16; ++index) {
      const bool is_gone = index >= 4 && index < 12;
      const cv::Mat image =
          is_gone ? scene->renderWithoutObject(index) : cv::Mat(scene->render(index).image);
      const std::string state = textOf(alone.update(image));
      ASSERT_EQ(state, textOf(together.update(image))) << "frame " << index;
      lost += alone.state().status == TrackingStatus::kLost ? 1 : 0;
    }
    EXPECT_GT(lost, 0);
  }
}

TEST(ChainTrackerLoss, boxLeavingTheImageIsLost) {
  const DrawnBox box;
  ChainTracker tracker = startTracker(box);
  for (int frame = 1; frame <= 30; ++frame) {
    const Similarity pose{0.0, 1.0, kStart.translation + frame * cv::Point2d(10, 0)};
    const ChainState& state = tracker.update(box.image(pose));
    if (pose.translation.x < 270.0) {
      ASSERT_NE(TrackingStatus::kLost, state.status) << frame;
    }
    if (pose.translation.x > 370.0) {
      ASSERT_EQ(TrackingStatus::kLost, state.status) << frame;
    }
  }
}

/// A wall along which the camera pans, so that all of it leaves to the left.
cv::Mat3b wallAfter(int frame) {
  static const cv::Mat3b wall = [] {
    cv::Mat1f grain(240, 900);
    cv::RNG(1).fill(grain, cv::RNG::NORMAL, 0.0, 8.0);
    cv::GaussianBlur(grain, grain, {}, 2.0);
    cv::Mat image;
    cv::merge(std::vector<cv::Mat>{grain + 110.0, grain + 130.0, grain + 120.0}, image);
    image.convertTo(image, CV_8U);
    return image;
  }();
  return wall.colRange(4 * frame, 4 * frame + 320);
}

/// Beyond the border its pixels go on, as if more of a plain object were seen there.
TEST(ChainTrackerLoss, whatIsSeenNowhereInTheImageIsLost) {
  ChainTracker tracker(shippedModel("worm"), wallAfter(0), {{30, 121}, {110, 125}});
  for (int frame = 1; frame <= 70; ++frame) {
    const ChainState& state = tracker.update(wallAfter(frame));
    if (state.status == TrackingStatus::kLost) continue;
    EXPECT_TRUE(
        std::any_of(state.parts.begin(), state.parts.end(),
                    [](const PartState& part) { return part.position.x + 0.5 * part.side > 0.0; }))
        << "frame " << frame;
  }
}

}  // namespace
}  // namespace chain_tracker
