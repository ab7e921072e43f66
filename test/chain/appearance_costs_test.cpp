// SPDX-License-Identifier: BSD-3-Clause
#include "chain/appearance_costs.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "chain_tracker/chain/chain_tracker.h"
#include "support/drawn_box.h"
#include "support/lattice_candidates.h"

namespace chain_tracker {
namespace {

const Similarity kStart{0.0, 1.0, {149.5, 109.5}};

/// A box of coloured squares, and what it costs to have its parts somewhere.
class AppearanceCostsTest : public testing::Test {
 protected:
  AppearanceCostsTest()
      : image_(DrawnBox().image(kStart)),
        state_(ChainTracker(model_, image_, DrawnBox::corners(kStart)).state()),
        layout_(layOut(model_, DrawnBox::corners(kStart))),
        costs_(model_.appearance, image_, layout_, state_) {}

  static ChainModel planarModel() {
    ChainModel model;
    model.segments[0].layout = Layout::kPlanar;
    return model;
  }

  SegmentCosts costsIn(const cv::Mat& image, SearchStage stage, double radius = 6.0) {
    std::vector<cv::Point2d> centers;
    for (const PartState& part : state_.parts) centers.push_back(part.position);
    const CandidateGrid grid = gridAround(centers, state_.parts.front().side, 1, radius);
    costs_.show(image);
    SegmentCosts costs;
    costs_.compute(state_, 0, 0.0, grid, stage, costs);
    return costs;
  }

  /// Comes to it so slowly that no change is one of the light all over the image at once.
  void fadeTo(const cv::Mat& image) {
    constexpr int kFrames = 30;
    for (int frame = 1; frame <= kFrames; ++frame) {
      const double share = static_cast<double>(frame) / kFrames;
      cv::Mat faded;
      cv::addWeighted(image_, 1.0 - share, image, share, 0.0, faded);
      costs_.show(faded);
    }
  }

  /// Of the visible parts where they are.
  double costThere(const cv::Mat& image) {
    const SegmentCosts costs = costsIn(image, SearchStage::kFine, 1.0);
    double sum = 0.0;
    for (size_t k = 0; k < state_.parts.size(); ++k) {
      const cv::Mat1f& map = costs.parts[k];
      if (state_.parts[k].visible) sum += map(map.rows / 2, map.cols / 2);
    }
    return sum;
  }

  const ChainModel model_ = planarModel();
  const cv::Mat image_;
  ChainState state_;
  const ChainLayout layout_;
  AppearanceCosts costs_;
};

TEST_F(AppearanceCostsTest, areLeastWhereThePartsAre) {
  for (const SearchStage stage : {SearchStage::kCoarse, SearchStage::kFine}) {
    const SegmentCosts costs = costsIn(image_, stage);
    ASSERT_EQ(state_.parts.size(), costs.parts.size());
    for (const cv::Mat1f& map : costs.parts) {
      cv::Point least;
      cv::minMaxLoc(map, nullptr, nullptr, &least);
      EXPECT_LE(cv::norm(least - cv::Point(map.size() / 2)), 1.5);
    }
  }
}

TEST_F(AppearanceCostsTest, tellTheShareOfEdgesInTheCoarseStage) {
  const SegmentCosts coarse = costsIn(image_, SearchStage::kCoarse);
  ASSERT_EQ(coarse.parts.size(), coarse.edges.size());
  for (size_t k = 0; k < coarse.parts.size(); ++k) {
    EXPECT_TRUE(std::equal(coarse.parts[k].begin(), coarse.parts[k].end(), coarse.edges[k].begin(),
                           [](float all, float edges) { return edges >= 0.0F && all >= edges; }));
  }
  EXPECT_TRUE(costsIn(image_, SearchStage::kFine).edges.empty());
}

/// What covers the object has a light of its own.
TEST_F(AppearanceCostsTest, partsThatAreHiddenDoNotTellTheLight) {
  cv::Mat seen = 0.7 * image_;
  for (PartState& part : state_.parts) {
    if (part.position.x < 140.0) continue;
    part.visible = false;
    const double half = 0.5 * part.side;
    const cv::Rect window(part.position - cv::Point2d(half, half),
                          part.position + cv::Point2d(half, half));
    image_(window).convertTo(seen(window), -1, 1.3);
  }
  const auto visible = std::count_if(state_.parts.begin(), state_.parts.end(),
                                     [](const PartState& part) { return part.visible; });
  ASSERT_GE(visible, 6);
  ASSERT_LT(2 * visible, static_cast<long>(state_.parts.size()));
  fadeTo(seen);
  const double before = costThere(seen);
  for (int frame = 0; frame < 30; ++frame) {
    costs_.show(seen);
    costs_.observeLight(state_);
  }
  EXPECT_LT(costThere(seen), 0.7 * before);
}

TEST_F(AppearanceCostsTest, lightThatChangesAllOverTheImageIsTold) {
  const cv::Mat dim = 0.6 * image_;
  const double at_once = costThere(dim);
  costThere(image_);
  fadeTo(dim);
  EXPECT_LT(at_once, 0.3 * costThere(dim));
}

TEST_F(AppearanceCostsTest, theLightOfTheFirstFrameIsKeptOnlyWhereTheObjectWasFoundInIt) {
  const cv::Mat dim = 0.6 * image_;
  fadeTo(dim);
  const double in_first_light = costThere(dim);
  for (int frame = 0; frame < 30; ++frame) {
    costs_.show(dim);
    costs_.observeLight(state_);
  }
  const double followed = costThere(dim);
  EXPECT_LT(followed, 0.7 * in_first_light);
  costs_.show(dim, SearchLight::kFirst);
  EXPECT_EQ(followed, costThere(dim));
  costs_.show(dim, SearchLight::kFirst);
  costs_.keepLight();
  EXPECT_EQ(in_first_light, costThere(dim));
}

}  // namespace
}  // namespace chain_tracker
