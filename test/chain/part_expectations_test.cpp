// SPDX-License-Identifier: BSD-3-Clause
#include "chain/part_expectations.h"

#include <gtest/gtest.h>

#include "support/drawn_box.h"

namespace chain_tracker {
namespace {

const Similarity kStart{0.0, 1.0, {129.5, 109.5}};

class PartExpectationsTest : public testing::Test {
 protected:
  PartExpectationsTest()
      : model_(planarModel()),
        layout_(layOut(model_, DrawnBox::corners(kStart))),
        appearance_(DrawnBox().image(kStart), layout_, model_.appearance),
        parts_(layout_.segments.front().parts.size()),
        expectations_(appearance_, model_.appearance, parts_) {}

  static ChainModel planarModel() {
    ChainModel model;
    model.segments[0].layout = Layout::kPlanar;
    return model;
  }

  /// A frame in which every part is that sure.
  ChainState frameOf(double confidence) const {
    ChainState state;
    state.confidence = confidence;
    state.parts.resize(parts_);
    for (PartState& part : state.parts) part.confidence = confidence;
    return state;
  }

  ChainModel model_;
  ChainLayout layout_;
  ObjectAppearance appearance_;
  size_t parts_;
  PartExpectations expectations_;
};

TEST_F(PartExpectationsTest, confidenceSinksFromOneToNoughtWithTheCost) {
  for (size_t part = 0; part < parts_; ++part) {
    EXPECT_EQ(1.0, expectations_.confidence(part, 0.0));
    EXPECT_EQ(0.0, expectations_.confidence(part, 1000.0));
    const double one = expectations_.confidence(part, 0.1);
    EXPECT_LT(one, 1.0);
    EXPECT_NEAR(1.0 - 2.0 * (1.0 - one), expectations_.confidence(part, 0.2), 1e-9);
  }
}

TEST_F(PartExpectationsTest, anOutlierHasItsShareOfTheUsualConfidence) {
  for (int frame = 0; frame < 400; ++frame) expectations_.observe(frameOf(0.6));
  for (size_t part = 0; part < parts_; ++part) {
    EXPECT_NEAR(0.3, expectations_.confidence(part, expectations_.outlierCost(part, 0.5)), 1e-6);
  }
}

TEST_F(PartExpectationsTest, partsAreSoonUsedToTheirNewLookAndTheObjectStaysInDoubt) {
  expectations_.observe(frameOf(0.9));
  EXPECT_EQ(0.9, expectations_.usualConfidence());
  for (int frame = 0; frame < 60; ++frame) expectations_.observe(frameOf(0.3));
  EXPECT_LT(expectations_.confidence(0, expectations_.outlierCost(0, 1.0)), 0.4);
  EXPECT_GT(expectations_.usualConfidence(), 0.75);
  for (int frame = 0; frame < 60; ++frame) expectations_.observe(frameOf(0.9));
  EXPECT_NEAR(0.9, expectations_.usualConfidence(), 1e-3);
}

TEST_F(PartExpectationsTest, hiddenShareGrowsFromNoughtToOne) {
  ChainState state = frameOf(0.5);
  for (PartState& part : state.parts) part.visible = true;
  double before = 0.0;
  EXPECT_EQ(0.0, expectations_.hiddenShare(state.parts));
  for (PartState& part : state.parts) {
    part.visible = false;
    const double share = expectations_.hiddenShare(state.parts);
    EXPECT_GT(share, before);
    before = share;
  }
  EXPECT_NEAR(1.0, before, 1e-9);
}

TEST_F(PartExpectationsTest, meanLiesBetweenThePartsAndIsTheirsWhereTheyAgree) {
  ChainState state = frameOf(0.5);
  EXPECT_NEAR(0.5, expectations_.meanConfidence(state.parts, 0, parts_), 1e-9);
  state.parts[1].confidence = 1.0;
  const double mean = expectations_.meanConfidence(state.parts, 0, 2);
  EXPECT_GT(mean, 0.5);
  EXPECT_LT(mean, 1.0);
  EXPECT_NEAR(1.0, expectations_.meanConfidence(state.parts, 1, 1), 1e-9);
}

}  // namespace
}  // namespace chain_tracker
