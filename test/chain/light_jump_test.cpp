// SPDX-License-Identifier: BSD-3-Clause
#include "chain/light_jump.h"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace chain_tracker {
namespace {

/// Blotches of about 30 px, of middling levels.
cv::Mat3b scene(int seed) {
  cv::Mat3b blotches(16, 22);
  cv::RNG random(static_cast<std::uint64_t>(seed));
  random.fill(blotches, cv::RNG::UNIFORM, 40, 160);
  cv::Mat3b image;
  cv::resize(blotches, image, {640, 480}, 0.0, 0.0, cv::INTER_CUBIC);
  return image;
}

cv::Mat inLight(const cv::Mat& image, const cv::Vec3d& light) {
  cv::Mat lit;
  cv::multiply(image, cv::Scalar(light), lit);
  return lit;
}

void expectRatios(const cv::Vec3d& expected, const cv::Vec3d& actual) {
  EXPECT_LT(cv::norm(expected - actual, cv::NORM_INF), 0.03) << actual;
}

const cv::Vec3d kNone = cv::Vec3d::all(1.0);

TEST(LightJump, isToldInEveryChannel) {
  const cv::Mat3b image = scene(1);
  for (const cv::Vec3d& light :
       {cv::Vec3d(0.7, 0.7, 0.7), cv::Vec3d(1.3, 1.3, 1.3), cv::Vec3d(0.8, 1.0, 1.2)}) {
    LightJump jump(image);
    expectRatios(light, jump.observe(inLight(image, light)));
    expectRatios(kNone, jump.observe(inLight(image, light)));
    expectRatios({1.0 / light[0], 1.0 / light[1], 1.0 / light[2]}, jump.observe(image));
  }
}

TEST(LightJump, isToldInGrey) {
  cv::Mat1b grey;
  cv::cvtColor(scene(2), grey, cv::COLOR_BGR2GRAY);
  LightJump jump(grey);
  expectRatios(cv::Vec3d::all(0.75), jump.observe(inLight(grey, cv::Vec3d::all(0.75))));
}

/// Drifts are for LightChange, which looks at the object.
TEST(LightJump, isNoDrift) {
  const cv::Mat3b image = scene(3);
  LightJump jump(image);
  for (double light = 1.0; light > 0.6; light *= 0.97) {
    EXPECT_EQ(kNone, jump.observe(inLight(image, cv::Vec3d::all(light)))) << light;
  }
}

TEST(LightJump, isNotWhatMoves) {
  LightJump jump(scene(4));
  for (int seed = 5; seed < 25; ++seed) EXPECT_EQ(kNone, jump.observe(scene(seed))) << seed;
  const cv::Mat3b image = scene(30);
  jump.observe(image);
  for (int step = 1; step < 20; ++step) {
    const cv::Rect view(12 * step, 0, 640 - 12 * step, 480);
    cv::Mat3b moved = image.clone();
    image(view).copyTo(moved(cv::Rect(cv::Point(), view.size())));
    EXPECT_EQ(kNone, jump.observe(moved)) << step;
  }
}

TEST(LightJump, isNotToldByAnObjectThatComesNear) {
  const cv::Mat3b image = scene(6);
  LightJump jump(image);
  cv::Mat3b covered = image.clone();
  covered(cv::Rect(0, 0, 300, 480)) = cv::Vec3b(220, 220, 220);
  EXPECT_EQ(kNone, jump.observe(covered));
}

TEST(LightJump, isNotToldByImagesThatAreBlackOrWhite) {
  LightJump jump(scene(7));
  EXPECT_EQ(kNone, jump.observe(cv::Mat3b(480, 640, cv::Vec3b(0, 0, 0))));
  EXPECT_EQ(kNone, jump.observe(cv::Mat3b(480, 640, cv::Vec3b(255, 255, 255))));
  EXPECT_EQ(kNone, jump.observe(scene(7)));
}

}  // namespace
}  // namespace chain_tracker
