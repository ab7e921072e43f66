// SPDX-License-Identifier: BSD-3-Clause
/// Lines of one colour: nothing but their ends tells how long they are and how far they lie along
/// themselves.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "chain_tracker/chain/chain_tracker.h"

namespace chain_tracker {
namespace {

using Polyline = std::vector<cv::Point2d>;

const cv::Point2d kMiddle(160.0, 120.0);
constexpr double kLength = 180.0;
/// What a point may be off [px]: two parts.
constexpr double kTwoParts = 12.0;

/// Red lines before another blur of noise in every frame.
class UniformLine {
 public:
  cv::Mat3b image(const Polyline& line, double thickness = 8.0) {
    constexpr int kFiner = 4;
    cv::Mat3b drawn(240, 320);
    random_.fill(drawn, cv::RNG::UNIFORM, 90, 170);
    cv::GaussianBlur(drawn, drawn, {}, 2.0);
    cv::resize(drawn, drawn, {}, kFiner, kFiner);
    std::vector<cv::Point> points;
    for (const cv::Point2d& point : line) points.emplace_back(point * 16.0 * kFiner);
    cv::polylines(drawn, points, false, {40, 60, 210}, cvRound(thickness * kFiner), cv::LINE_AA, 4);
    cv::resize(drawn, drawn, {}, 1.0 / kFiner, 1.0 / kFiner, cv::INTER_AREA);
    return drawn;
  }

 private:
  cv::RNG random_{5};
};

ChainModel lineModel() {
  ChainModel model;
  SegmentModel& segment = model.segments[0];
  segment.layout = Layout::kDeformable;
  segment.parts = 32;
  segment.aspect = 0.04;
  segment.window = 1.0;
  segment.orientation_hypotheses = segment.scale_hypotheses = 1;
  return model;
}

Polyline straight(double angle, double length = kLength) {
  const cv::Point2d half = 0.5 * length * cv::Point2d(std::cos(angle), std::sin(angle));
  return {kMiddle - half, kMiddle + half};
}

/// Points in equal steps of a line of kLength that leads where `direction` has it at a share of
/// its length; its mean is in the middle of the image.
Polyline curve(const std::function<double(double)>& direction) {
  constexpr int kSteps = 60;
  Polyline line = {{0.0, 0.0}};
  cv::Point2d mean;
  for (int k = 0; k < kSteps; ++k) {
    const double angle = direction((k + 0.5) / kSteps);
    line.push_back(line.back() + kLength / kSteps * cv::Point2d(std::cos(angle), std::sin(angle)));
    mean += line.back() / (kSteps + 1.0);
  }
  for (cv::Point2d& point : line) point += kMiddle - mean;
  return line;
}

void expectEnds(const Polyline& truth, const ChainState& state, double tolerance) {
  EXPECT_LT(cv::norm(state.points.front().position - truth.front()), tolerance);
  EXPECT_LT(cv::norm(state.points.back().position - truth.back()), tolerance);
}

TEST(UniformLine, keepsItsLengthWhileItTurns) {
  UniformLine line;
  ChainTracker tracker(lineModel(), line.image(straight(0.0)), straight(0.0));
  double angle = 0.0;
  for (int frame = 1; frame <= 150; ++frame) {
    const ChainState& state = tracker.update(line.image(straight(angle += 0.02)));
    EXPECT_NEAR(1.0, state.segments[0].image_from_segment.scale, 0.1);
    if (frame % 30 != 0) continue;
    SCOPED_TRACE("frame " + std::to_string(frame));
    EXPECT_NEAR(kLength, cv::norm(state.points[1].position - state.points[0].position), 9.0);
    expectEnds(straight(angle), state, 9.0);
  }
}

TEST(UniformLine, isNotTakenAlongByWaves) {
  UniformLine line;
  const auto wave = [](int frame) {
    return curve([frame](double along) {
      return 0.9 * std::min(1.0, frame / 40.0) *
             std::sin(2.0 * CV_PI * (1.5 * along - frame / 60.0));
    });
  };
  ChainTracker tracker(lineModel(), line.image(wave(0)), wave(0));
  for (int frame = 1; frame <= 180; ++frame) {
    const ChainState& state = tracker.update(line.image(wave(frame)));
    SCOPED_TRACE("frame " + std::to_string(frame));
    if (frame % 20 == 0) expectEnds(wave(frame), state, kTwoParts);
  }
}

/// Within 160 frames.
void expectRescaled(double last_scale) {
  UniformLine line;
  const auto scale = [&](int frame) { return 1.0 + (last_scale - 1.0) * frame / 160.0; };
  ChainTracker tracker(lineModel(), line.image(straight(0.2)), straight(0.2));
  for (int frame = 1; frame <= 160; ++frame) {
    const Polyline truth = straight(0.2, scale(frame) * kLength);
    const ChainState& state = tracker.update(line.image(truth, 8.0 * scale(frame)));
    if (frame % 40 != 0) continue;
    SCOPED_TRACE("frame " + std::to_string(frame));
    EXPECT_NEAR(scale(frame), state.segments[0].image_from_segment.scale, 0.08);
    expectEnds(truth, state, kTwoParts);
  }
}

TEST(UniformLine, comesNearer) { expectRescaled(1.3); }
TEST(UniformLine, goesAway) { expectRescaled(0.7); }

/// The ends of the line are not those that were given.
TEST(UniformLine, keepsItsLengthWhereMoreOfTheSameGoesOn) {
  UniformLine line;
  const Polyline all = straight(0.2, 1.5 * kLength);
  ChainTracker tracker(lineModel(), line.image(all), straight(0.2));
  for (int frame = 1; frame <= 100; ++frame) tracker.update(line.image(all));
  const ChainState& state = tracker.state();
  EXPECT_NEAR(kLength, cv::norm(state.points[1].position - state.points[0].position), 9.0);
}

/// It looks the same either way round.
TEST(UniformLine, isNotTurnedRoundWhenItIsFoundAgain) {
  UniformLine line;
  const auto shifted = [](double by) {
    Polyline ends = straight(0.2);
    for (cv::Point2d& end : ends) end.y += by;
    return ends;
  };
  ChainTracker tracker(lineModel(), line.image(shifted(0.0)), shifted(0.0));
  for (int frame = 1; frame <= 10; ++frame) tracker.update(line.image(shifted(0.0)));
  for (int frame = 1; frame <= 10; ++frame) tracker.update(line.image({{0.0, 0.0}, {1.0, 0.0}}));
  ASSERT_EQ(TrackingStatus::kLost, tracker.state().status);
  for (int frame = 1; frame <= 10; ++frame) tracker.update(line.image(shifted(30.0)));
  ASSERT_NE(TrackingStatus::kLost, tracker.state().status);
  expectEnds(shifted(30.0), tracker.state(), kTwoParts);
}

}  // namespace
}  // namespace chain_tracker
