// SPDX-License-Identifier: BSD-3-Clause
#include "chain/placement_search.h"

#include <cmath>

#include <gtest/gtest.h>

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/object_appearance.h"
#include "support/drawn_arm.h"
#include "support/drawn_box.h"
#include "support/random_inputs.h"

namespace chain_tracker {
namespace {

double costOf(const Placement& placement, const std::vector<cv::Mat1f>& costs,
              const std::vector<cv::Point2d>& offsets, int turns) {
  double sum = 0.0;
  const double angle = placement.turn * 2.0 * CV_PI / turns;
  for (size_t k = 0; k < costs.size(); ++k) {
    const double x = std::cos(angle) * offsets[k].x - std::sin(angle) * offsets[k].y;
    const double y = std::sin(angle) * offsets[k].x + std::cos(angle) * offsets[k].y;
    sum += costs[k](placement.middle + cv::Point(cvRound(x), cvRound(y)));
  }
  return sum;
}

TEST(CheapestPlacement, isTheBestOfAll) {
  RandomInputs random(3);
  for (int repeat = 0; repeat < 20; ++repeat) {
    const auto parts = static_cast<size_t>(random.integer(1, 5));
    const int turns = random.integer(1, 9);
    const cv::Rect middles(6, 7, random.integer(1, 8), random.integer(1, 8));
    const std::vector<cv::Mat1f> costs = random.costMaps(parts, {20, 22});
    const std::vector<cv::Point2d> offsets = random.points(parts, -4.0, 4.0);
    Placement least;
    double least_cost = 1e9;
    for (int turn = 0; turn < turns; ++turn) {
      for (int y = 0; y < middles.height; ++y) {
        for (int x = 0; x < middles.width; ++x) {
          const Placement placement{turn, middles.tl() + cv::Point(x, y)};
          const double cost = costOf(placement, costs, offsets, turns);
          if (cost >= least_cost) continue;
          least_cost = cost;
          least = placement;
        }
      }
    }
    const Placement found = cheapestPlacement(costs, offsets, middles, turns);
    EXPECT_EQ(least.turn, found.turn);
    EXPECT_EQ(least.middle, found.middle);
  }
}

TEST(CheapestPlacement, threadsChangeNothing) {
  RandomInputs random(4);
  for (int threads = 2; threads <= 5; ++threads) {
    const std::vector<cv::Mat1f> costs = random.costMaps(3, {120, 110});
    const std::vector<cv::Point2d> offsets = random.points(3, -9.0, 9.0);
    const cv::Rect middles(15, 15, 90, 80);
    const Placement alone = cheapestPlacement(costs, offsets, middles, 32);
    const Placement together = cheapestPlacement(costs, offsets, middles, 32, threads);
    EXPECT_EQ(alone.turn, together.turn);
    EXPECT_EQ(alone.middle, together.middle);
    EXPECT_EQ(alone.cost, together.cost);
  }
}

/// Learns an object, and looks for it in another image.
class Search {
 public:
  Search(const ChainModel& model, const cv::Mat& image, const std::vector<cv::Point2d>& points)
      : layout_(layOut(forPolyline(model, points.size()), points)),
        appearance_(image, layout_, model.appearance),
        search_(model.appearance, image.size()) {}

  std::vector<Similarity> find(const cv::Mat& image, const JointModel& limits = JointModel(),
                               const JointRest& rest = JointRest()) {
    learnLinks(limits, rest);
    FramePixels pixels(appearance_.palette(), image);
    return search_.find(segments_, hinges_, 200.0, pixels);
  }

  std::vector<Similarity> hang(const cv::Mat& image, const std::vector<bool>& seen) {
    learnLinks(JointModel(), JointRest());
    FramePixels pixels(appearance_.palette(), image);
    return search_.hang(segments_, hinges_, seen, pixels);
  }

 private:
  void learnLinks(const JointModel& limits, const JointRest& rest) {
    segments_.clear();
    hinges_.clear();
    size_t part = 0;
    for (const SegmentLayout& layout : layout_.segments) {
      RigidSegment segment;
      segment.side = layout.parts.front().side;
      segment.pose = {layout.image_from_segment.angle, 1.0};
      for (const PartLayout& own : layout.parts) {
        segment.voters.push_back({layout.image_from_segment.apply(own.position),
                                  appearance_.part(part++, 0.0).colors, 4.0});
      }
      segments_.push_back(segment);
      if (!layout.exit) continue;
      hinges_.push_back({layout.image_from_segment.apply(*layout.exit), limits, rest});
    }
  }

  ChainLayout layout_;
  ObjectAppearance appearance_;
  PlacementSearch search_;
  std::vector<RigidSegment> segments_;
  std::vector<Hinge> hinges_;
};

/// Learns the box at `start`.
Search boxSearch(const DrawnBox& box, const Similarity& start) {
  ChainModel model;
  model.segments[0].layout = Layout::kPlanar;
  return {model, box.image(start), DrawnBox::corners(start)};
}

TEST(PlacementSearch, findsABoxAnywhereAtAnyOrientation) {
  const Similarity start{0.0, 1.0, {80.0, 70.0}};
  const DrawnBox box;
  Search search = boxSearch(box, start);
  for (const double angle : {0.0, 0.9, 2.2, -1.6}) {
    const Similarity there{angle, 1.0, {210.0, 150.0}};
    const Similarity motion = search.find(box.image(there)).front();
    EXPECT_NEAR(0.0, wrapAngle(motion.angle - angle), 0.2) << angle;
    EXPECT_LT(cv::norm(motion.apply(start.translation) - there.translation), 6.0) << angle;
  }
}

ChainModel linksOf() {
  ChainModel model;
  model.segment_per_edge = true;
  model.segments[0].parts = 8;
  return model;
}

TEST(PlacementSearch, findsAnArmThatHasBent) {
  const cv::Point2d start(60.0, 60.0);
  const cv::Point2d there(120.0, 150.0);
  const std::vector<double> angles = {0.2, 0.6, 0.1};
  const std::vector<double> bent = {-0.9, -0.1, 0.8};
  const DrawnArm arm(3);
  const std::vector<cv::Point2d> before = DrawnArm::vertices(start, angles);
  const std::vector<cv::Point2d> after = DrawnArm::vertices(there, bent);
  Search search(linksOf(), arm.image(start, angles), before);
  const std::vector<Similarity> motions = search.find(arm.image(there, bent));
  ASSERT_EQ(3U, motions.size());
  for (size_t m = 0; m < 3; ++m) {
    EXPECT_LT(cv::norm(motions[m].apply(before[m]) - after[m]), 10.0) << m;
    EXPECT_LT(cv::norm(motions[m].apply(before[m + 1]) - after[m + 1]), 10.0) << m;
  }
}

TEST(PlacementSearch, doesNotBendBeyondAJointsLimits) {
  const cv::Point2d start(60.0, 60.0);
  const cv::Point2d there(120.0, 150.0);
  const DrawnArm arm(2);
  Search search(linksOf(), arm.image(start, {0.2, 0.6}), DrawnArm::vertices(start, {0.2, 0.6}));
  const cv::Mat bent = arm.image(there, {-0.9, 0.7});
  const std::vector<Similarity> free = search.find(bent);
  EXPECT_NEAR(1.6, wrapAngle(free[1].angle + 0.6 - free[0].angle - 0.2), 0.2);
  const std::vector<Similarity> limited = search.find(bent, {0.0, 1.0});
  EXPECT_LT(wrapAngle(limited[1].angle + 0.6 - limited[0].angle - 0.2), 1.2);
}

TEST(PlacementSearch, bendsAJointTowardsItsRest) {
  const cv::Point2d start(60.0, 60.0);
  const cv::Point2d there(120.0, 150.0);
  const std::vector<double> angles = {0.2, 0.6};
  const DrawnArm arm(2);
  Search search(linksOf(), arm.image(start, angles), DrawnArm::vertices(start, angles));
  const cv::Mat bent = arm.image(there, {-0.9, 0.7});
  const std::vector<Similarity> rested = search.find(bent, JointModel(), {0.4, 0.05});
  EXPECT_NEAR(0.4, wrapAngle(rested[1].angle + 0.6 - rested[0].angle - 0.2), 0.2);
}

TEST(PlacementSearch, hangsWhatIsNotSeenFromWhatIs) {
  const cv::Point2d start(140.0, 110.0);
  const std::vector<double> angles = {0.2, 0.6, 0.1};
  const DrawnArm arm(3);
  const std::vector<cv::Point2d> before = DrawnArm::vertices(start, angles);
  Search search(linksOf(), arm.image(start, angles), before);

  const std::vector<double> ahead = {0.2, 2.0, -2.6};
  const std::vector<cv::Point2d> after = DrawnArm::vertices(start, ahead);
  const std::vector<Similarity> on = search.hang(arm.image(start, ahead), {true, false, false});
  EXPECT_EQ(0.0, on[0].angle);
  for (size_t m = 1; m < 3; ++m) {
    EXPECT_NEAR(0.0, wrapAngle(on[m].angle - ahead[m] + angles[m]), 0.2) << m;
    EXPECT_LT(cv::norm(on[m].apply(before[m + 1]) - after[m + 1]), 10.0) << m;
  }

  // The last link stays where it was.
  const std::vector<double> behind = {1.2, -0.8, 0.1};
  const cv::Point2d first = before[2] - DrawnArm::vertices({0.0, 0.0}, behind)[2];
  const std::vector<Similarity> back = search.hang(arm.image(first, behind), {false, false, true});
  EXPECT_EQ(0.0, back[2].angle);
  for (size_t m = 0; m < 2; ++m) {
    EXPECT_NEAR(0.0, wrapAngle(back[m].angle - behind[m] + angles[m]), 0.2) << m;
  }
}

TEST(PlacementSearch, placesTheMiddleInsideTheImageWhateverItShows) {
  const Similarity start{0.0, 1.0, {80.0, 70.0}};
  const DrawnBox box;
  Search search = boxSearch(box, start);
  const Similarity motion = search.find(box.background()).front();
  const cv::Point2d middle = motion.apply(start.translation);
  EXPECT_TRUE(cv::Rect2d(-8.0, -8.0, 336.0, 256.0).contains(middle)) << middle;
}

}  // namespace
}  // namespace chain_tracker
