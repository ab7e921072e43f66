// SPDX-License-Identifier: BSD-3-Clause
/// What the tracker does not take, and that it is as before when it refused.
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "chain_tracker/chain/chain_tracker.h"
#include "support/drawn_box.h"
#include "support/refusal.h"
#include "support/state_text.h"

namespace chain_tracker {
namespace {

const Similarity kStart{0.0, 1.0, {150.0, 110.0}};

ChainModel modelOf(Layout layout) {
  ChainModel model;
  model.segments[0].layout = layout;
  return model;
}

std::string refusalOf(const ChainModel& model, const cv::Mat& image,
                      const std::vector<cv::Point2d>& points) {
  return chain_tracker::refusalOf([&] { ChainTracker(model, image, points); });
}

/// Corners of a box in an image of 320 x 240.
std::string refusalOfBox(const cv::Rect2d& box) {
  const cv::Point2d low = box.tl();
  const cv::Point2d high = box.br();
  return refusalOf(modelOf(Layout::kPlanar), DrawnBox().image(kStart),
                   {low, {high.x, low.y}, high, {low.x, high.y}});
}

TEST(ChainTrackerRefuses, aFaultyModel) {
  ChainModel model = modelOf(Layout::kPlanar);
  model.segments[0].parts = 1;
  EXPECT_EQ("", omissionsOf(refusalOf(model, DrawnBox().image(kStart), DrawnBox::corners(kStart)),
                            {"segments[0]/parts is 1", "[2, 200]"}));
}

TEST(ChainTrackerRefuses, imagesThatAreEmptyOrOfAnotherType) {
  const auto refusal = [](const cv::Mat& image) {
    return refusalOf(modelOf(Layout::kPlanar), image, DrawnBox::corners(kStart));
  };
  EXPECT_EQ("", omissionsOf(refusal(cv::Mat()), {"empty"}));
  EXPECT_EQ("", omissionsOf(refusal(cv::Mat(240, 320, CV_8UC4)), {"CV_8UC4", "CV_8UC3"}));
  EXPECT_EQ("", omissionsOf(refusal(cv::Mat(240, 320, CV_16UC1)), {"CV_16UC1", "CV_8UC1"}));
}

TEST(ChainTrackerRefuses, imagesThatShowNothing) {
  const cv::Mat black(240, 320, CV_8UC3, cv::Scalar());
  EXPECT_EQ("", omissionsOf(refusalOf(modelOf(Layout::kPlanar), black, DrawnBox::corners(kStart)),
                            {"nothing to follow", "0 of 255"}));
}

TEST(ChainTrackerRefuses, partsThatDoNotFit) {
  const cv::Mat strip(10, 320, CV_8UC3, cv::Scalar(1, 2, 3));
  ChainModel model = modelOf(Layout::kPlanar);
  model.segments[0].parts = 2;
  EXPECT_EQ("", omissionsOf(refusalOf(model, strip, {{0, 0}, {90, 0}, {90, 60}, {0, 60}}),
                            {"2 parts", "body", "10", "320x10"}));
  EXPECT_EQ("", omissionsOf(refusalOfBox({100, 100, 8, 6}), {"parts", "px wide", "4"}));
}

TEST(ChainTrackerRefuses, targetsOutsideTheImage) {
  EXPECT_EQ("", omissionsOf(refusalOfBox({400, 100, 60, 40}), {"320x240", "x 400 to 460"}));
  EXPECT_EQ("", omissionsOf(refusalOfBox({-500, 100, 60, 40}), {"320x240", "x -500 to -440"}));
  EXPECT_EQ("", omissionsOf(refusalOfBox({100, 1e6, 60, 40}), {"320x240"}));
  EXPECT_EQ("", omissionsOf(refusalOfBox({290, 100, 63, 40}), {"320x240"}));
  EXPECT_EQ("", refusalOfBox({280, 100, 63, 40}));
}

TEST(ChainTrackerRefuses, numbersTooLargeForAnImage) {
  for (double huge : {1e9, 1e18, 1e300}) {
    EXPECT_NE("", refusalOfBox({huge, 100, 60, 40})) << huge;
    EXPECT_NE("", refusalOfBox({100, 100, huge, 40})) << huge;
    EXPECT_NE("", refusalOf(modelOf(Layout::kDeformable), DrawnBox().image(kStart),
                            {{10, 10}, {huge, 10}}))
        << huge;
    EXPECT_NE("", refusalOf(modelOf(Layout::kElongated), DrawnBox().image(kStart),
                            {{10, 10}, {huge, huge}}))
        << huge;
  }
}

TEST(ChainTrackerRefuses, linesThatOnlyPassRoundTheImage) {
  ChainModel model = modelOf(Layout::kDeformable);
  model.segments[0].aspect = 0.001;
  EXPECT_NE("", refusalOf(model, DrawnBox().image(kStart), {{-9, -9}, {-9, 250}, {330, 250}}));
}

TEST(ChainTrackerRefuses, pointsThatMakeNoShape) {
  const cv::Mat image = DrawnBox().image(kStart);
  EXPECT_EQ("", omissionsOf(refusalOf(modelOf(Layout::kElongated), image, {{5, 7}, {5, 7}}),
                            {"points 0 and 1", "(5, 7)"}));
  EXPECT_EQ("", omissionsOf(refusalOf(modelOf(Layout::kElongated), image, {{5, 7}}),
                            {"body", "1 points", "2 ends"}));
  EXPECT_EQ("", omissionsOf(refusalOf(modelOf(Layout::kPlanar), image, {{5, 7}, {50, 70}}),
                            {"body", "2 points", "4 corners"}));
  EXPECT_EQ("", omissionsOf(refusalOf(modelOf(Layout::kDeformable), image, {}),
                            {"body", "0 points", "at least 2"}));
  EXPECT_EQ(
      "", omissionsOf(refusalOf(modelOf(Layout::kDeformable), image, {{5, 7}, {std::nan(""), 70}}),
                      {"point 1", "nan", "finite"}));
}

TEST(ChainTrackerRefuses, imagesUnlikeTheFirstAndStaysAsItWas) {
  const DrawnBox box;
  const auto start = [&] {
    return ChainTracker(modelOf(Layout::kPlanar), box.image(kStart), DrawnBox::corners(kStart));
  };
  ChainTracker tracker = start();
  ChainTracker untroubled = start();
  const std::vector<std::pair<cv::Mat, std::string>> strangers = {
      {cv::Mat(), "empty"},
      {cv::Mat(240, 320, CV_8UC1, cv::Scalar(9)), "CV_8UC1"},
      {cv::Mat(240, 320, CV_16UC3, cv::Scalar(9)), "CV_16UC3"},
      {cv::Mat(240, 321, CV_8UC3, cv::Scalar(9)), "321x240"},
      {cv::Mat(320, 240, CV_8UC3, cv::Scalar(9)), "240x320"}};
  for (int frame = 1; frame <= 3; ++frame) {
    for (const auto& [image, reason] : strangers) {
      const cv::Mat stranger = image;
      const std::string before = textOf(tracker.state());
      EXPECT_EQ("",
                omissionsOf(chain_tracker::refusalOf([&] { tracker.update(stranger); }), {reason}));
      EXPECT_EQ(before, textOf(tracker.state()));
    }
    const cv::Mat next = box.image({0.04 * frame, 1.0, {150.0 + 4 * frame, 110.0}});
    EXPECT_EQ(textOf(untroubled.update(next)), textOf(tracker.update(next)));
  }
}

TEST(ChainTrackerRefuses, toUseNoThreadsOrTooMany) {
  ChainTracker tracker(modelOf(Layout::kPlanar), DrawnBox().image(kStart),
                       DrawnBox::corners(kStart));
  for (const int threads : {-1, 0, 257}) {
    EXPECT_EQ("", omissionsOf(chain_tracker::refusalOf([&] { tracker.useThreads(threads); }),
                              {"threads is " + std::to_string(threads), "[1, 256]"}));
  }
}

TEST(ChainTrackerTakes, theSmallestTargetsAndImages) {
  ChainModel model = modelOf(Layout::kPlanar);
  model.segments[0].parts = 2;
  model.segments[0].margin = 0.0;
  cv::Mat image(6, 10, CV_8UC3, cv::Scalar(10, 90, 200));
  image.colRange(0, 5).setTo(cv::Scalar(10, 200, 90));
  ChainTracker tracker(model, image, {{0, 0}, {9, 0}, {9, 5}, {0, 5}});
  const ChainState& state = tracker.update(image);
  EXPECT_EQ(2U, state.parts.size());
  for (const PartState& part : state.parts) EXPECT_TRUE(std::isfinite(part.position.x));
}

TEST(ChainTrackerTakes, targetsThatStickOutOfTheImage) {
  const DrawnBox box;
  const Similarity start{0.0, 1.0, {20.0, 110.0}};
  ChainTracker tracker(modelOf(Layout::kPlanar), box.image(start), DrawnBox::corners(start));
  const Similarity next{0.0, 1.0, {25.0, 113.0}};
  const ChainState& state = tracker.update(box.image(next));
  EXPECT_NE(TrackingStatus::kLost, state.status);
  EXPECT_LT(cv::norm(state.segments[0].image_from_segment.translation - next.translation), 3.0);
}

}  // namespace
}  // namespace chain_tracker
