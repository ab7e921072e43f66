// SPDX-License-Identifier: BSD-3-Clause
#include "chain/light_change.h"

#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

constexpr size_t kParts = 9;
constexpr double kUnit = ChannelGains::kUnit;

/// Parts of one colour that all show as much of the object.
std::vector<ObjectColor> partsOf(const cv::Vec3d& color, double share = 1.0) {
  return std::vector<ObjectColor>(kParts, ObjectColor{share, color});
}

/// After having seen the same for so long that no rate matters.
ChannelGains settled(const std::vector<ObjectColor>& learned,
                     const std::vector<ObjectColor>& seen) {
  LightChange light(0.5);
  for (int frame = 0; frame < 60; ++frame) light.observe(learned, seen);
  return light.gains();
}

/// To two steps: dark channels count for less than they are.
void expectGains(const cv::Vec3d& expected, const ChannelGains& gains) {
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(expected[c], gains.steps[static_cast<size_t>(c)] / kUnit, 0.016) << "channel " << c;
  }
}

TEST(LightChange, isNoneAtFirst) { expectGains({1, 1, 1}, LightChange(0.3).gains()); }

TEST(LightChange, isUndoneInEveryChannel) {
  const cv::Vec3d color(100, 150, 120);
  expectGains({1, 1, 1}, settled(partsOf(color), partsOf(color)));
  expectGains({1.25, 1, 0.8}, settled(partsOf(color), partsOf({80, 150, 150})));
  expectGains({0.8, 1, 1.25}, settled(partsOf({80, 150, 150}), partsOf(color)));
}

TEST(LightChange, isFollowedByTheRate) {
  for (double rate : {0.0, 0.25, 1.0}) {
    LightChange light(rate);
    light.observe(partsOf({100, 100, 100}), partsOf({80, 80, 80}));
    EXPECT_NEAR(1.0 + 0.25 * rate, light.gains().steps[1] / kUnit, 0.011) << rate;
  }
}

/// What covers some of the parts is not the light.
TEST(LightChange, isWhatMostPartsSay) {
  const cv::Vec3d color(100, 150, 120);
  std::vector<ObjectColor> seen = partsOf(0.8 * color);
  for (size_t k = 0; k < kParts / 2; ++k) seen[k].mean = {255, 5, 255};
  expectGains({1.25, 1.25, 1.25}, settled(partsOf(color), seen));
}

TEST(LightChange, isToldByPartsThatShowTheObject) {
  const cv::Vec3d color(100, 150, 120);
  std::vector<ObjectColor> learned = partsOf(color);
  std::vector<ObjectColor> seen = partsOf(0.8 * color);
  for (size_t k = 0; k < 6; ++k) {
    seen[k].mean = {255, 5, 255};
    (k % 2 == 0 ? learned : seen)[k].share = 0.1;
  }
  expectGains({1.25, 1.25, 1.25}, settled(learned, seen));
}

TEST(LightChange, isNotToldByTwoParts) {
  std::vector<ObjectColor> seen = partsOf({50, 50, 50}, 0.0);
  seen[0].share = seen[1].share = 1.0;
  expectGains({1, 1, 1}, settled(partsOf({100, 100, 100}), seen));
  seen[2].share = 1.0;
  expectGains({1.96, 1.96, 1.96}, settled(partsOf({100, 100, 100}), seen));
  expectGains({1, 1, 1}, settled({}, {}));
}

TEST(LightChange, thatIsTooLargeToBeUndoneEndsWhereItBegan) {
  LightChange light(0.3);
  light.jump({0.3, 3.0, 0.9});
  expectGains({2, 0.5, 1.11}, light.gains());
  light.jump({1.0 / 0.3, 1.0 / 3.0, 1.0 / 0.9});
  expectGains({1, 1, 1}, light.gains());
}

TEST(LightChange, isBounded) {
  expectGains({2, 2, 2}, settled(partsOf({250, 250, 250}), partsOf({0, 0, 1})));
  expectGains({0.5, 0.5, 0.5}, settled(partsOf({0, 0, 1}), partsOf({250, 250, 250})));
}

}  // namespace
}  // namespace chain_tracker
