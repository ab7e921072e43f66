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

  /// Of a frame in which every part is that sure.
  std::vector<PartState> frameOf(double confidence) const {
    std::vector<PartState> parts(parts_);
    for (PartState& part : parts) part.confidence = confidence;
    return parts;
  }

  /// A frame in which every part is that sure, and the object looks as much as learned.
  void observe(double confidence) { expectations_.observe(frameOf(confidence), confidence); }

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

/// A third of the box is outside the image: whatever it may cost there.
TEST_F(PartExpectationsTest, partsThatTheFirstFrameDidNotShowTellNothing) {
  const Similarity start{0.0, 1.0, {14.5, 109.5}};
  const ChainLayout layout = layOut(model_, DrawnBox::corners(start));
  ObjectAppearance appearance(DrawnBox().image(start), layout, model_.appearance);
  const PartExpectations expectations(appearance, model_.appearance, parts_);
  std::vector<PartState> parts(parts_);
  std::vector<double> costs(parts_, 0.0);
  int unknown = 0;
  for (size_t k = 0; k < parts_; ++k) {
    const bool is_known = appearance.part(k, 0.0).known > 0.0F;
    unknown += is_known ? 0 : 1;
    EXPECT_EQ(is_known ? 1.0 : 0.0, expectations.confidence(k, 0.0)) << "part " << k;
    parts[k].confidence = is_known ? 0.8 : 0.0;
    parts[k].visible = is_known;
    costs[k] = is_known ? 0.0 : 1.0;
  }
  EXPECT_LT(0, unknown);
  EXPECT_NEAR(0.8, expectations.meanConfidence(parts, 0, parts_), 2e-3);
  EXPECT_NEAR(0.0, expectations.hiddenShare(parts), 2e-3);
  EXPECT_NEAR(1.0, expectations.likeness(costs, std::vector<double>(parts_, 1.0)), 2e-3);
}

TEST_F(PartExpectationsTest, theUsualConfidenceFollowsWhatIsObserved) {
  EXPECT_NEAR(1.0, expectations_.usualConfidence(), 1e-9);
  observe(0.4);
  EXPECT_LT(expectations_.usualConfidence(), 1.0);
  EXPECT_GT(expectations_.usualConfidence(), 0.9);
  for (int frame = 0; frame < 400; ++frame) observe(0.4);
  EXPECT_NEAR(0.4, expectations_.usualConfidence(), 1e-6);
}

TEST_F(PartExpectationsTest, anOutlierHasItsShareOfTheUsualConfidence) {
  for (int frame = 0; frame < 400; ++frame) observe(0.6);
  for (size_t part = 0; part < parts_; ++part) {
    EXPECT_NEAR(0.7 * expectations_.colorOutlierCost(part, 0.0),
                expectations_.colorOutlierCost(part, 0.5), 1e-6);
    EXPECT_NEAR(0.7 * expectations_.outlierCost(part, 0.0), expectations_.outlierCost(part, 0.5),
                1e-6);
  }
}

TEST_F(PartExpectationsTest, partsAreSoonUsedToTheirNewLookAndTheObjectStaysInDoubt) {
  observe(0.9);
  EXPECT_EQ(0.9, expectations_.usualLikeness());
  for (int frame = 0; frame < 60; ++frame) observe(0.3);
  EXPECT_GT(expectations_.outlierCost(0, 1.0), 0.6 * expectations_.outlierCost(0, 0.0));
  EXPECT_GT(expectations_.usualLikeness(), 0.75);
  for (int frame = 0; frame < 60; ++frame) observe(0.9);
  EXPECT_NEAR(0.9, expectations_.usualLikeness(), 1e-3);
}

TEST_F(PartExpectationsTest, hiddenShareGrowsFromNoughtToOne) {
  std::vector<PartState> parts = frameOf(0.5);
  for (PartState& part : parts) part.visible = true;
  double before = 0.0;
  EXPECT_EQ(0.0, expectations_.hiddenShare(parts));
  for (PartState& part : parts) {
    part.visible = false;
    const double share = expectations_.hiddenShare(parts);
    EXPECT_GT(share, before);
    before = share;
  }
  EXPECT_NEAR(1.0, before, 1e-9);
}

TEST_F(PartExpectationsTest, meanLiesBetweenThePartsAndIsTheirsWhereTheyAgree) {
  std::vector<PartState> parts = frameOf(0.5);
  EXPECT_NEAR(0.5, expectations_.meanConfidence(parts, 0, parts_), 1e-9);
  parts[1].confidence = 1.0;
  const double mean = expectations_.meanConfidence(parts, 0, 2);
  EXPECT_GT(mean, 0.5);
  EXPECT_LT(mean, 1.0);
  EXPECT_NEAR(1.0, expectations_.meanConfidence(parts, 1, 1), 1e-9);
}

/// What all channels could cost is what an outlier costs of which nothing is usual.
TEST_F(PartExpectationsTest, likenessSinksFromOneToNoughtWithTheCostsOfAllChannels) {
  const std::vector<double> all(parts_, 1.0);
  std::vector<double> costs(parts_, 0.0);
  EXPECT_NEAR(1.0, expectations_.likeness(costs, all), 1e-9);
  for (size_t part = 0; part < parts_; ++part) {
    costs[part] = 0.25 * expectations_.outlierCost(part, 0.0);
  }
  EXPECT_NEAR(0.75, expectations_.likeness(costs, all), 1e-9);
  costs.assign(parts_, 1000.0);
  EXPECT_NEAR(0.0, expectations_.likeness(costs, all), 1e-9);
}

TEST_F(PartExpectationsTest, outsideTheImageAllIsExpectedToLookAsTheRestDoes) {
  const std::vector<double> all(parts_, 1.0);
  std::vector<double> evidence;
  for (size_t k = 0; k < parts_; ++k) evidence.push_back(expectations_.outlierCost(k, 0.0));
  std::vector<double> outside(parts_, 0.0);
  std::vector<double> costs = evidence;
  double unseen = 0.0;
  double told = 0.0;
  for (size_t k = 0; k < parts_; ++k) {
    if (k % 3 == 0) outside[k] = 1.0;
    if (k % 3 != 0) costs[k] = 0.0;
    if (k % 3 == 0) unseen += evidence[k];
    told += evidence[k];
  }
  unseen /= told;
  EXPECT_NEAR(1.0 - unseen, expectations_.likeness(costs, all), 1e-9);
  EXPECT_NEAR(1.0 - 0.1 * unseen,
              expectations_.expectedLikeness(expectations_.likeness(costs, all), all, outside),
              1e-9);

  // The rest looks half as usual: what is outside is believed to look half as well as that.
  for (size_t k = 0; k < parts_; ++k) costs[k] = k % 3 == 0 ? evidence[k] : 0.5 * evidence[k];
  const double seen = expectations_.likeness(costs, all);
  EXPECT_NEAR(0.5 * (1.0 - unseen), seen, 1e-9);
  EXPECT_NEAR(seen + 0.9 * 0.5 * 0.5 * unseen,
              expectations_.expectedLikeness(expectations_.likeness(costs, all), all, outside),
              1e-9);
}

TEST_F(PartExpectationsTest, wholeObjectsAreExpectedAsTheyAreAndUnseenOnesNotAtAll) {
  const std::vector<double> all(parts_, 1.0);
  std::vector<double> costs;
  for (size_t k = 0; k < parts_; ++k) costs.push_back(0.1 * double(k % 7));
  EXPECT_EQ(expectations_.likeness(costs, all),
            expectations_.expectedLikeness(expectations_.likeness(costs, all), all,
                                           std::vector<double>(parts_, 0.0)));
  costs.assign(parts_, 1000.0);
  EXPECT_EQ(0.0, expectations_.expectedLikeness(expectations_.likeness(costs, all), all, all));
}

TEST_F(PartExpectationsTest, whatTwoPartsSeeIsLikeOnlyOnce) {
  const std::vector<double> halves(parts_, 0.5);
  EXPECT_NEAR(0.5, expectations_.likeness(std::vector<double>(parts_, 0.0), halves), 1e-9);
}

TEST_F(PartExpectationsTest, edgesCountOnlyWhereTheModelLooksAtThem) {
  AppearanceModel without = model_.appearance;
  without.edge_weight = 0.0;
  const PartExpectations blind(appearance_, without, parts_);
  double more = 0.0;
  for (size_t part = 0; part < parts_; ++part) {
    more += expectations_.outlierCost(part, 0.0) - blind.outlierCost(part, 0.0);
    EXPECT_EQ(expectations_.confidence(part, 2.0), blind.confidence(part, 2.0));
  }
  EXPECT_GT(more, 0.0);
}

}  // namespace
}  // namespace chain_tracker
