// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "chain_tracker/evaluation/evaluated_tracker.h"
#include "chain_tracker/evaluation/metrics.h"
#include "support/refusal.h"

namespace chain_tracker {
namespace {

/// A reddish textured board before a bluish textured wall; it moves by 3 px a frame.
class MovingBoard {
 public:
  MovingBoard()
      : wall_(texture({320, 240}, {200, 90, 60})), board_(texture(kSize, {40, 60, 220})) {}

  static cv::Rect boxAt(int frame) { return {{60 + 3 * frame, 90}, kSize}; }

  cv::Mat frame(int index) const {
    cv::Mat image = wall_.clone();
    board_.copyTo(image(boxAt(index)));
    return image;
  }

 private:
  static const cv::Size kSize;

  static cv::Mat texture(const cv::Size& size, const cv::Scalar& color) {
    cv::RNG random(3);
    cv::Mat image(size, CV_8UC3);
    random.fill(image, cv::RNG::UNIFORM, 0, 255);
    cv::GaussianBlur(image, image, cv::Size(9, 9), 0.0);
    return (image - cv::Scalar::all(127)) * 2.0 + color;
  }

  cv::Mat wall_;
  cv::Mat board_;
};

const cv::Size MovingBoard::kSize{60, 36};

class EveryBaseline : public testing::TestWithParam<std::string> {};

TEST_P(EveryBaseline, FollowsABoardThatMoves) {
  const MovingBoard scene;
  const auto tracker = makeBaseline(GetParam(), MovingBoard::boxAt(0));
  EXPECT_EQ(tracker->name(), GetParam());
  const TrackedFrame first = tracker->start(scene.frame(0));
  EXPECT_FALSE(first.lost);
  EXPECT_EQ(first.box, cv::Rect2d(MovingBoard::boxAt(0)));
  for (int i = 1; i < 20; ++i) {
    const TrackedFrame tracked = tracker->update(scene.frame(i));
    EXPECT_FALSE(tracked.lost) << "frame " << i;
    EXPECT_GT(intersectionOverUnion(tracked.box, MovingBoard::boxAt(i)), 0.6) << "frame " << i;
    EXPECT_TRUE(tracked.points.empty());
  }
}

TEST_P(EveryBaseline, GivesTheSameBoxesAgain) {
  const MovingBoard scene;
  std::vector<cv::Rect2d> boxes[2];
  for (std::vector<cv::Rect2d>& run : boxes) {
    const auto tracker = makeBaseline(GetParam(), MovingBoard::boxAt(0));
    tracker->start(scene.frame(0));
    for (int i = 1; i < 6; ++i) run.push_back(tracker->update(scene.frame(i)).box);
  }
  EXPECT_EQ(boxes[0], boxes[1]);
}

INSTANTIATE_TEST_SUITE_P(All, EveryBaseline, testing::ValuesIn(baselineNames()),
                         [](const auto& baseline) { return baseline.param; });

TEST(Baselines, NamesAreThoseOfTheBuild) {
  const std::vector<std::string> names = baselineNames();
  for (const char* name : {"camshift", "mil"}) {
    EXPECT_TRUE(std::count(names.begin(), names.end(), name)) << name;
  }
}

TEST(Baselines, AnUnknownNameIsRefusedWithThoseThatAre) {
  EXPECT_EQ(omissionsOf(refusalOf([] {
                          makeBaseline("goturn", {1, 2, 3, 4});
                        }),
                        {"baseline is 'goturn'", "camshift", "mil"}),
            "");
}

}  // namespace
}  // namespace chain_tracker
