// SPDX-License-Identifier: BSD-3-Clause
#include "chain/line_alignment.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "chain/line_motion.h"
#include "chain_tracker/chain/object_appearance.h"

namespace chain_tracker {
namespace {

constexpr size_t kParts = 24;
constexpr double kLength = 240.0;
constexpr double kWidth = 8.0;
constexpr double kPartLength = kLength / double(kParts - 1);

constexpr double kSwing = 30.0;

/// A winding line as wide as the image, on which an object lies [px].
std::vector<cv::Point2d> winding(double swing = kSwing) {
  std::vector<cv::Point2d> way;
  for (int x = 10; x <= 490; x += 2) way.emplace_back(x, 100.0 + swing * std::sin(x / 45.0));
  return way;
}

cv::Mat background() {
  cv::Mat3b image(200, 500);
  cv::RNG(5).fill(image, cv::RNG::UNIFORM, 100, 140);
  return image;
}

/// Draws marks of a few colours in no order, from `start` on along the line.
cv::Mat drawn(double start, double scale, double swing = kSwing) {
  const std::vector<cv::Scalar> colors = {
      {40, 40, 220}, {40, 220, 40}, {220, 40, 40}, {30, 220, 220}};
  const std::vector<size_t> marks = {0, 1, 2, 1, 3, 0, 2, 2, 3, 1, 0, 3};
  const std::vector<cv::Point2d> way = winding(swing);
  cv::Mat image = background();
  const double mark = scale * kLength / static_cast<double>(marks.size());
  for (int place = 0; place < scale * kLength; ++place) {
    const auto now = std::min(marks.size() - 1, static_cast<size_t>(place / mark));
    cv::circle(image, pointAlong(way, start + place), cvRound(0.5 * kWidth * scale),
               colors[marks[now]], cv::FILLED);
  }
  return image;
}

/// Of a line from `start` on, at equal distances.
std::vector<cv::Point2d> placesOf(double start, double scale, double swing = kSwing) {
  std::vector<cv::Point2d> points;
  for (size_t k = 0; k < kParts; ++k) {
    points.push_back(pointAlong(winding(swing), start + scale * kPartLength * double(k)));
  }
  return points;
}

ChainModel lineModel() {
  ChainModel model;
  model.segments[0].layout = Layout::kDeformable;
  model.segments[0].parts = kParts;
  return model;
}

/// Learns a line of scale 1, and aligns what lies wrong on it.
class Line {
 public:
  static constexpr double kStart = 60.0;

  explicit Line(double swing = kSwing)
      : swing_(swing),
        layout_(layOut(lineModel(), placesOf(kStart, 1.0, swing))),
        appearance_(drawn(kStart, 1.0, swing), layout_, lineModel().appearance),
        alignment_(layout_.segments.front(), lineModel().appearance, background().size()) {}

  /// Along the drawn line from `start` on, all visible.
  ChainState laid(double start, double scale, bool is_reversed = false) const {
    const SegmentLayout& segment = layout_.segments.front();
    ChainState line;
    line.parts.resize(kParts);
    line.segments.resize(1);
    line.segments[0].part_count = static_cast<int>(kParts);
    line.segments[0].image_from_segment = segment.image_from_segment;
    line.segments[0].image_from_segment.scale = scale;
    const std::vector<cv::Point2d> places = placesOf(start, scale, swing_);
    for (size_t k = 0; k < kParts; ++k) {
      line.parts[k].position = places[k];
      line.parts[k].visible = true;
    }
    if (is_reversed) reverse(line);
    return line;
  }

  bool align(const cv::Mat& image, bool is_uniform, ChainState& line) {
    std::vector<Voter> voters;
    for (size_t k = 0; k < kParts; ++k) {
      voters.push_back({line.parts[k].position, appearance_.part(k, 0.0).colors, 4.0});
    }
    FramePixels pixels(appearance_.palette(), image);
    const double side = layout_.segments.front().parts.front().side;
    return alignment_.align(voters, side * line.segments.front().image_from_segment.scale,
                            is_uniform, pixels, line);
  }

 private:
  double swing_;
  ChainLayout layout_;
  ObjectAppearance appearance_;
  LineAlignment alignment_;
};

double largestError(const ChainState& line, const std::vector<cv::Point2d>& truth) {
  double largest = 0.0;
  for (size_t k = 0; k < kParts; ++k) {
    largest = std::max(largest, cv::norm(line.parts[k].position - truth[k]));
  }
  return largest;
}

TEST(LineAlignment, shiftsALineThatIsLevel) {
  constexpr double kLevel = 0.0;
  Line line(kLevel);
  ChainState shifted = line.laid(Line::kStart + 3.0 * kPartLength, 1.0);
  ASSERT_TRUE(line.align(drawn(Line::kStart, 1.0, kLevel), false, shifted));
  EXPECT_LT(largestError(shifted, placesOf(Line::kStart, 1.0, kLevel)), kPartLength);
}

constexpr int kTurns = 4;

/// In one of the turns at least, as in some no line becomes shorter. What `wrong` leaves out goes
/// straight on, so that this must not be much of it.
void expectAligned(const ChainState& wrong, double start, double scale) {
  Line line;
  const std::vector<cv::Point2d> truth = placesOf(start, scale);
  ASSERT_GT(largestError(wrong, truth), 2.0 * kPartLength);
  ChainState best = wrong;
  for (int turn = 0; turn < kTurns; ++turn) {
    ChainState aligned = wrong;
    line.align(drawn(start, scale), false, aligned);
    if (largestError(aligned, truth) < largestError(best, truth)) best = aligned;
  }
  EXPECT_LT(largestError(best, truth), kPartLength);
  const Similarity& pose = best.segments[0].image_from_segment;
  EXPECT_NEAR(scale, pose.scale, 0.04 * scale);
  const bool is_reversed = liesReversed(wrong, line.laid(start, scale));
  const double turned = wrapAngle(pose.angle - wrong.segments[0].image_from_segment.angle);
  EXPECT_NEAR(is_reversed ? CV_PI : 0.0, std::abs(turned), 1e-9);
}

TEST(LineAlignment, slidesALineBack) {
  expectAligned(Line().laid(33.0, 1.0), 60.0, 1.0);
  expectAligned(Line().laid(87.0, 1.0), 60.0, 1.0);
}

TEST(LineAlignment, lengthensWhatIsTooShort) {
  expectAligned(Line().laid(80.0, 0.8), 70.0, 1.0);
  expectAligned(Line().laid(90.0, 0.9), 70.0, 1.2);
}

TEST(LineAlignment, shortensWhatIsTooLong) { expectAligned(Line().laid(60.0, 1.3), 80.0, 1.0); }

TEST(LineAlignment, shortensNothingInHalfOfTheCalls) {
  Line line;
  int shortened = 0;
  for (int turn = 0; turn < kTurns; ++turn) {
    ChainState wrong = line.laid(60.0, 1.3);
    line.align(drawn(80.0, 1.0), false, wrong);
    shortened += wrong.segments[0].image_from_segment.scale < 1.3 ? 1 : 0;
  }
  EXPECT_EQ(kTurns / 2, shortened);
}

TEST(LineAlignment, turnsALineRound) {
  expectAligned(Line().laid(60.0, 1.0, true), 60.0, 1.0);
  expectAligned(Line().laid(80.0, 0.8, true), 60.0, 1.0);
}

TEST(LineAlignment, leavesALineThatLiesRight) {
  Line line;
  ChainState right = line.laid(62.0, 1.0);
  EXPECT_FALSE(line.align(drawn(60.0, 1.0), false, right));
  EXPECT_LT(largestError(right, placesOf(62.0, 1.0)), 1e-9);
}

TEST(LineAlignment, merelyShiftsAUniformLine) {
  Line line;
  ChainState wrong = line.laid(80.0, 0.8, true);
  const Similarity pose = wrong.segments[0].image_from_segment;
  ASSERT_TRUE(line.align(drawn(60.0, 1.0), true, wrong));
  EXPECT_EQ(0.8, wrong.segments[0].image_from_segment.scale);
  EXPECT_EQ(pose.angle, wrong.segments[0].image_from_segment.angle);
  EXPECT_TRUE(liesReversed(wrong, line.laid(60.0, 1.0)));
}

TEST(LineAlignment, tellsNothingWhereHardlyAnythingIsSeen) {
  Line line;
  ChainState hidden = line.laid(80.0, 1.0);
  for (size_t k = 4; k < kParts; ++k) hidden.parts[k].visible = false;
  EXPECT_FALSE(line.align(drawn(60.0, 1.0), false, hidden));
  EXPECT_LT(largestError(hidden, placesOf(80.0, 1.0)), 1e-9);
}

}  // namespace
}  // namespace chain_tracker
