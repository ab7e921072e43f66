// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/haar/sparse_kernel.h"

#include <gtest/gtest.h>

#include "chain_tracker/haar/convolution_plan.h"
#include "chain_tracker/haar/double_difference.h"
#include "chain_tracker/haar/shipped_ensembles.h"
#include "support/haar_inputs.h"
#include "support/refusal.h"

namespace chain_tracker::haar {
namespace {

TEST(SparseKernel, dividesProductsOnly) {
  const SparseKernel a({{0, 0, 2}, {1, 3, -1}, {2, 1, 5}});
  const SparseKernel b({{0, 0, 3}, {0, 2, -3}, {4, 0, 1}});
  EXPECT_EQ(a, (a * b).dividedBy(b).value());
  EXPECT_EQ(b, (a * b).dividedBy(a).value());
  EXPECT_FALSE((a * b + SparseKernel::one()).dividedBy(b));
  EXPECT_FALSE(SparseKernel::one().dividedBy(SparseKernel({{0, 0, 2}})));
}

TEST(SparseKernel, isEqualUpToShiftSignAndScaleWhenAligned) {
  const SparseKernel kernel({{0, 0, 1}, {0, 4, -2}, {3, 1, 1}});
  const AlignedKernel aligned = alignedKernel(kernel.shifted({-5, 7}).scaled(-6));
  EXPECT_EQ(kernel, aligned.primitive);
  EXPECT_EQ(cv::Point(-5, 7), aligned.delay);
  EXPECT_EQ(-6, aligned.scale);
}

TEST(SparseKernel, printsItself) {
  EXPECT_EQ("1 - 3 X^2 + X Y^4", SparseKernel({{0, 0, 1}, {0, 2, -3}, {4, 1, 1}}).text());
  EXPECT_EQ("0", SparseKernel().text());
}

TEST(DoubleDifference, hasTheCornersOfTheClassicWay) {
  size_t corners = 0;
  const FeatureEnsemble surf = surfEnsemble();
  for (const HaarFeature& feature : surf.features()) corners += doubleDifference(feature).size();
  EXPECT_EQ(128U, corners);
  EXPECT_EQ(12U, surf.size());
  EXPECT_EQ(185 + 25, classicAccesses(violaJonesEnsemble()));
}

/// Sums of positive and negative weights, pixel by pixel.
TEST(DoubleDifference, provesTheRangeThatExtremeImagesReach) {
  RandomInputs random(3);
  for (int round = 0; round < 50; ++round) {
    const FeatureEnsemble ensemble = randomEnsemble(random, 1, 9);
    const HaarFeature& feature = ensemble.features().front();
    cv::Mat1i weights(64, 64, 0);
    for (const WeightedRectangle& r : feature.rectangles) {
      weights(cv::Rect(r.x + 32, r.y + 32, r.width, r.height)) += r.weight;
    }
    cv::Mat positive = cv::max(weights, 0);
    cv::Mat negative = cv::min(weights, 0);
    const ValueRange range = rangeOnImage(doubleDifference(feature), 255).value();
    EXPECT_EQ(static_cast<std::int64_t>(255 * cv::sum(positive)[0]), range.high);
    EXPECT_EQ(static_cast<std::int64_t>(255 * cv::sum(negative)[0]), range.low);
  }
}

TEST(DoubleDifference, hasNoRangeForKernelsThatGrowWithTheImage) {
  EXPECT_FALSE(rangeOnImage(SparseKernel::differenceX(3), 255));
  EXPECT_FALSE(rangeOnImage(SparseKernel::differenceY(3), 255));
  EXPECT_TRUE(rangeOnImage(SparseKernel::differenceX(3) * SparseKernel::differenceY(2), 255));
}

TEST(ConvolutionPlan, widensOrRefusesByName) {
  EXPECT_EQ(Lane::k16, ConvolutionPlan(boxEnsemble({16, 16})).steps().back().lane);
  EXPECT_EQ(Lane::k32, ConvolutionPlan(boxEnsemble({17, 17})).steps().back().lane);
  PlanOptions masks;
  masks.max_pixel = 1;
  EXPECT_EQ(Lane::k16, ConvolutionPlan(boxEnsemble({255, 255}), masks).steps().back().lane);
  const FeatureEnsemble huge("e", {{"huge", {{0, 0, 3000, 3000, 1}}}});
  EXPECT_EQ("", omissionsOf(refusalOf([&] { ConvolutionPlan plan(huge); }),
                            {"'e'", "'huge'", "2295000000", "32 bits"}));
  PlanOptions wrong;
  wrong.max_pixel = 256;
  EXPECT_EQ("", omissionsOf(refusalOf([&] {
                              ConvolutionPlan plan(boxEnsemble({2, 2}), wrong);
                            }),
                            {"max_pixel", "256"}));
}

TEST(ConvolutionPlan, describesItself) {
  const ConvolutionPlan plan(boxEnsemble({3, 5}));
  EXPECT_EQ("",
            omissionsOf(plan.describe(), {"classic 5, parsed 5", "proven", "box", "[0, 3825]"}));
  EXPECT_EQ("", omissionsOf(plan.dot(), {"digraph", "n0 -> n1", "box"}));
}

TEST(FeatureEnsemble, refusesWhatIsNoEnsemble) {
  EXPECT_EQ("", omissionsOf(refusalOf([] { FeatureEnsemble("e", {}); }), {"'e'", "no features"}));
  EXPECT_EQ("", omissionsOf(refusalOf([] { FeatureEnsemble("e", {{"a", {}}}); }), {"'a'"}));
}

}  // namespace
}  // namespace chain_tracker::haar
