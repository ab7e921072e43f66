// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/haar/parser.h"

#include <gtest/gtest.h>

#include "chain_tracker/haar/ensemble_io.h"
#include "chain_tracker/haar/shipped_ensembles.h"
#include "support/exhaustive_parser.h"
#include "support/haar_inputs.h"
#include "support/refusal.h"

namespace chain_tracker::haar {
namespace {

/// Empty if every node is what its edge makes of its parent, and every feature is its node.
std::string faultOf(const PassTree& tree, const FeatureEnsemble& ensemble) {
  if (!(tree.nodes.front().kernel == SparseKernel::one())) return "node 0 is not 1";
  for (size_t i = 1; i < tree.nodes.size(); ++i) {
    const PassNode& node = tree.nodes[i];
    if (node.parent < 0 || node.parent >= static_cast<int>(i)) return "a parent comes too late";
    if (!(node.edge * tree.nodes[static_cast<size_t>(node.parent)].kernel == node.kernel)) {
      return "node " + std::to_string(i) + " is not its edge times its parent";
    }
  }
  const std::vector<AlignedKernel> kernels = alignedKernels(ensemble);
  for (size_t i = 0; i < kernels.size(); ++i) {
    const FeatureNode& feature = tree.features[i];
    const bool same =
        tree.nodes[static_cast<size_t>(feature.node)].kernel == kernels[i].primitive &&
        feature.delay == kernels[i].delay && feature.scale == kernels[i].scale;
    if (!same) return "feature " + std::to_string(i) + " is another kernel than its node";
  }
  return "";
}

TEST(Parser, needsAtMost75AccessesForSurf) {
  const FeatureEnsemble surf = surfEnsemble();
  EXPECT_EQ(140, classicAccesses(surf));
  const PassTree tree = parse(surf);
  EXPECT_EQ("", faultOf(tree, surf));
  EXPECT_LE(tree.accesses(), 75);
}

TEST(Parser, isNeverWorseThanTheClassicWay) {
  RandomInputs random(1);
  for (int round = 0; round < 40; ++round) {
    SCOPED_TRACE(round);
    const FeatureEnsemble ensemble = randomEnsemble(random, 1 + round % 8, 2 + round % 13);
    for (const bool factor : {true, false}) {
      ParserOptions options;
      options.factor = factor;
      options.search_rounds = 2;
      options.exact_work = 0;
      const PassTree tree = parse(ensemble, options);
      EXPECT_EQ("", faultOf(tree, ensemble));
      EXPECT_LE(tree.accesses(), classicAccesses(ensemble));
      const PassTree separate = parseSeparately(ensemble, options);
      EXPECT_EQ("", faultOf(separate, ensemble));
      EXPECT_LE(separate.accesses(), classicAccesses(ensemble));
    }
  }
  for (const std::string& name : shippedEnsembleNames()) {
    EXPECT_LT(parse(shippedEnsemble(name)).accesses(), classicAccesses(shippedEnsemble(name)));
  }
}

struct SmallEnsembles {
  int features;
  int largest_side;
  int ensembles;
};

class SmallEnsemblesParser : public testing::TestWithParam<SmallEnsembles> {};

TEST_P(SmallEnsemblesParser, equalsExhaustiveSearch) {
  RandomInputs random(1);
  for (int i = 0; i < GetParam().ensembles; ++i) {
    SCOPED_TRACE(i);
    const FeatureEnsemble ensemble =
        randomShapes(random, GetParam().features, GetParam().largest_side);
    const PassTree tree = parse(ensemble);
    EXPECT_EQ("", faultOf(tree, ensemble));
    EXPECT_TRUE(tree.isProvenBest());
    EXPECT_EQ(exhaustive::fewestAccesses(ensemble, tree.accesses()), tree.accesses());
  }
}

INSTANTIATE_TEST_SUITE_P(Features, SmallEnsemblesParser,
                         testing::Values(SmallEnsembles{1, 5, 8}, SmallEnsembles{2, 4, 8},
                                         SmallEnsembles{3, 3, 6}, SmallEnsembles{4, 3, 4},
                                         SmallEnsembles{5, 2, 6}, SmallEnsembles{6, 2, 3}));

TEST(Parser, tellsWhatEveryTreeNeedsAtLeast) {
  const FeatureEnsemble surf = surfEnsemble();
  const PassTree tree = parse(surf);
  EXPECT_LE(tree.least_accesses, tree.accesses());
  EXPECT_GE(tree.least_accesses, 40);
  ParserOptions nothing_proven;
  nothing_proven.exact_work = 0;
  EXPECT_LT(parse(surf, nothing_proven).least_accesses, tree.least_accesses);
}

TEST(Parser, equalsExhaustiveSearchForBoxesThatDoubleInSize) {
  const FeatureEnsemble boxes(
      "boxes", {{"a", {{0, 0, 2, 2, 1}}}, {"b", {{0, 0, 4, 4, 1}}}, {"c", {{0, 0, 2, 4, 1}}}});
  const PassTree tree = parse(boxes);
  EXPECT_TRUE(tree.isProvenBest());
  EXPECT_EQ(exhaustive::fewestAccesses(boxes), tree.accesses());
}

TEST(Parser, computesKernelsEqualUpToShiftSignAndScaleOnce) {
  const FeatureEnsemble copies(
      "copies", {{"a", {{0, 0, 3, 5, 1}}}, {"b", {{7, -2, 3, 5, -1}}}, {"c", {{-4, 1, 3, 5, 6}}}});
  const PassTree tree = parse(copies);
  EXPECT_EQ(2U, tree.nodes.size());
  EXPECT_EQ(4 + 3, tree.accesses());
}

TEST(Parser, refusesRectanglesThatCancel) {
  const FeatureEnsemble zero("e", {{"zero", {{0, 0, 4, 4, 1}, {0, 0, 4, 4, -1}}}});
  EXPECT_EQ("", omissionsOf(refusalOf([&] { parse(zero); }), {"'e'", "'zero'", "cancel"}));
}

TEST(Parser, parsesTheFrontalFaceCascade) {
  if (cascadeFolder().empty()) GTEST_SKIP() << "the package opencv-data is not installed";
  const CascadeFeatures cascade =
      loadCascade(cascadeFolder() + "/haarcascade_frontalface_default.xml");
  EXPECT_EQ(2913U, cascade.upright.size());
  EXPECT_TRUE(cascade.tilted.empty());
  const PassTree tree = parse(cascade.upright);
  EXPECT_EQ("", faultOf(tree, cascade.upright));
  EXPECT_LT(tree.accesses(), classicAccesses(cascade.upright) / 4);
}

}  // namespace
}  // namespace chain_tracker::haar
