// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/edge_directions.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/random_inputs.h"

namespace chain_tracker {
namespace {

/// Sum over three pixels beside the middle one of the difference across it; `across` is one pixel
/// in the direction of the difference.
int slowGradient(const cv::Mat1b& grey, const cv::Point& middle, const cv::Point& across) {
  const cv::Point along(across.y, across.x);
  int sum = 0;
  for (int i = -1; i <= 1; ++i) {
    sum += grey(middle + across + i * along) - grey(middle - across + i * along);
  }
  return sum;
}

/// By the angle of the gradient.
int slowCode(int right, int down) {
  if (std::abs(right) + std::abs(down) < 3 * kLeastContrast) return kNoEdge;
  const double eighths = std::atan2(down, right) / (CV_PI / 4.0);
  return 1 + (static_cast<int>(std::lround(eighths)) + 8) % 8;
}

/// Whether the two directions nearest to a gradient are equally near, to a degree.
bool isBetweenDirections(int right, int down) {
  const double eighths = std::atan2(down, right) / (CV_PI / 4.0);
  const double rest = eighths - std::floor(eighths);
  return std::abs(rest - 0.5) < 1.0 / 45.0;
}

TEST(EdgeDirections, equalTheAnglesOfSlowGradients) {
  RandomInputs random(1);
  EdgeDirections directions;
  for (const cv::Size& size :
       {cv::Size(3, 3), cv::Size(40, 31), cv::Size(7, 90), cv::Size(33, 4)}) {
    const cv::Mat1b grey = random.noise(size, CV_8UC1);
    cv::Mat1b codes(size - cv::Size(2, 2));
    directions.compute(grey, codes);
    const std::vector<cv::Mat1i> gradients = directions.gradients(grey);
    ASSERT_EQ(codes.size(), gradients[0].size());
    ASSERT_EQ(codes.size(), gradients[1].size());
    for (int y = 0; y < codes.rows; ++y) {
      for (int x = 0; x < codes.cols; ++x) {
        const cv::Point middle(x + 1, y + 1);
        const int right = slowGradient(grey, middle, {1, 0});
        const int down = slowGradient(grey, middle, {0, 1});
        ASSERT_EQ(right, gradients[0](y, x));
        ASSERT_EQ(down, gradients[1](y, x));
        if (isBetweenDirections(right, down)) continue;
        ASSERT_EQ(slowCode(right, down), codes(y, x)) << right << ", " << down;
      }
    }
  }
}

TEST(EdgeDirections, needOnePixelMoreOnAllSides) {
  EXPECT_EQ(cv::Rect(4, 6, 12, 22), EdgeDirections::neededFor({5, 7, 10, 20}));
}

TEST(EdgeCode, countsEighthsOfATurnFromTheXAxisTowardsY) {
  for (int direction = 0; direction < 8; ++direction) {
    for (const double off : {-0.36, 0.0, 0.36}) {  // a sixteenth of a turn is 0.39
      const double angle = direction * CV_PI / 4.0 + off;
      const auto right = static_cast<float>(100.0 * std::cos(angle));
      const auto down = static_cast<float>(100.0 * std::sin(angle));
      EXPECT_EQ(1 + direction, edgeCode(right, down)) << angle;
    }
  }
}

TEST(EdgeCode, isNoneBelowTheLeastContrast) {
  const auto least = static_cast<float>(3 * kLeastContrast);
  EXPECT_EQ(kNoEdge, edgeCode(0.99F * least, 0.0F));
  EXPECT_EQ(kNoEdge, edgeCode(-0.5F * least, 0.49F * least));
  EXPECT_EQ(1, edgeCode(least, 0.0F));
  EXPECT_EQ(4, edgeCode(-0.5F * least, 0.5F * least));
}

}  // namespace
}  // namespace chain_tracker
