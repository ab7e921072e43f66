// SPDX-License-Identifier: BSD-3-Clause
#include "chain/length_evidence.h"

#include <cmath>

#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

/// Roots of the shares of two colours, of which the first has `share`.
RootHistogram colorsOf(double share) {
  return {static_cast<float>(std::sqrt(share)), static_cast<float>(std::sqrt(1.0 - share))};
}

/// 24 parts that show the first colour in these shares, `period` parts each.
std::vector<RootHistogram> stripes(double even, double odd, size_t period) {
  std::vector<RootHistogram> colors;
  for (size_t k = 0; k < 24; ++k) colors.push_back(colorsOf(k / period % 2 == 0 ? even : odd));
  return colors;
}

TEST(LengthEvidence, isNoneOfOneColour) {
  EXPECT_EQ(0.0, lengthEvidence(stripes(0.7, 0.7, 4)));
  EXPECT_EQ(0.0, lengthEvidence(stripes(0.7, 0.73, 4)));  // as noise makes it
}

TEST(LengthEvidence, isAllOfMarksHoweverFarApart) {
  for (size_t period = 1; period <= 8; ++period) {
    EXPECT_EQ(1.0, lengthEvidence(stripes(1.0, 0.0, period))) << period;
  }
}

TEST(LengthEvidence, growsWithTheDistanceOfTheColours) {
  const double alike = std::sqrt(0.3 * 0.6) + std::sqrt(0.7 * 0.4);
  EXPECT_NEAR((std::sqrt(1.0 - alike) - 0.15) / 0.15, lengthEvidence(stripes(0.3, 0.6, 4)), 1e-6);
  EXPECT_LT(lengthEvidence(stripes(0.3, 0.55, 4)), lengthEvidence(stripes(0.3, 0.6, 4)));
}

TEST(LengthEvidence, ofClearMarksIsBeyondDoubt) {
  EXPECT_TRUE(isClearlyMarked(stripes(0.0, 1.0, 4)));
  EXPECT_FALSE(isClearlyMarked(stripes(0.3, 0.6, 4)));
}

TEST(LengthEvidence, isNoneOfASinglePart) { EXPECT_EQ(0.0, lengthEvidence({colorsOf(0.5)})); }

}  // namespace
}  // namespace chain_tracker
