// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/chain_model.h"

#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "support/refusal.h"

namespace chain_tracker {
namespace {

/// A number of the model and the range it must lie in.
struct Limits {
  std::string key;
  std::function<void(ChainModel&, double)> set;
  double low;
  double high;
  bool whole = false;
};

Limits segmentLimits(const std::string& key, double SegmentModel::*member, double low,
                     double high) {
  return {"segments[0]/" + key,
          [member](ChainModel& model, double value) { model.segments[0].*member = value; }, low,
          high};
}

Limits segmentLimits(const std::string& key, int SegmentModel::*member, int low, int high) {
  const auto set = [member](ChainModel& model, double value) {
    model.segments[0].*member = static_cast<int>(value);
  };
  return {"segments[0]/" + key, set, double(low), double(high), true};
}

Limits appearanceLimits(const std::string& key, double AppearanceModel::*member, double low,
                        double high) {
  return {"appearance/" + key,
          [member](ChainModel& model, double value) { model.appearance.*member = value; }, low,
          high};
}

Limits searchLimits(const std::string& key, double SearchModel::*member, double low, double high) {
  const auto set = [member](ChainModel& model, double value) {
    model.search.lost_below = 0.0;
    model.search.found_above = 1.0;
    model.search.*member = value;
  };
  return {"search/" + key, set, low, high};
}

std::vector<Limits> allLimits() {
  return {
      segmentLimits("parts", &SegmentModel::parts, 2, 200),
      segmentLimits("aspect", &SegmentModel::aspect, 0.001, 1.0),
      segmentLimits("margin", &SegmentModel::margin, 0.0, 1.0),
      segmentLimits("window", &SegmentModel::window, 0.2, 10.0),
      segmentLimits("stretch_sigma", &SegmentModel::stretch_sigma, 0.005, 1.0),
      segmentLimits("bend_sigma", &SegmentModel::bend_sigma, 0.005, 3.0),
      segmentLimits("shape_memory", &SegmentModel::shape_memory, 0.0, 1.0),
      segmentLimits("orientation_hypotheses", &SegmentModel::orientation_hypotheses, 1, 63),
      segmentLimits("orientation_step", &SegmentModel::orientation_step, 0.005, 1.0),
      segmentLimits("orientation_sigma", &SegmentModel::orientation_sigma, 0.005, 10.0),
      segmentLimits("scale_hypotheses", &SegmentModel::scale_hypotheses, 1, 15),
      segmentLimits("scale_step", &SegmentModel::scale_step, 0.002, 0.5),
      segmentLimits("scale_sigma", &SegmentModel::scale_sigma, 0.002, 10.0),
      {"appearance/palette_colors",
       [](ChainModel& model, double value) {
         model.appearance.palette_colors = static_cast<int>(value);
       },
       2, 254, true},
      appearanceLimits("ring", &AppearanceModel::ring, 0.05, 3.0),
      appearanceLimits("min_object_share", &AppearanceModel::min_object_share, 0.0, 0.95),
      appearanceLimits("weight", &AppearanceModel::weight, 0.1, 1000.0),
      appearanceLimits("edge_weight", &AppearanceModel::edge_weight, 0.0, 1000.0),
      appearanceLimits("haar_weight", &AppearanceModel::haar_weight, 0.0, 1000.0),
      appearanceLimits("outlier_below", &AppearanceModel::outlier_below, 0.0, 1.0),
      appearanceLimits("outlier_slope", &AppearanceModel::outlier_slope, 0.0, 1.0),
      appearanceLimits("light_rate", &AppearanceModel::light_rate, 0.0, 1.0),
      searchLimits("radius", &SearchModel::radius, 0.002, 1.0),
      searchLimits("lost_below", &SearchModel::lost_below, 0.0, 1.0),
      searchLimits("lost_share", &SearchModel::lost_share, 0.0, 0.8),
      searchLimits("found_above", &SearchModel::found_above, 0.0, 1.0),
      searchLimits("occluded_below", &SearchModel::occluded_below, 0.0, 1.0),
      searchLimits("travel_weight", &SearchModel::travel_weight, 0.0, 100.0),
      searchLimits("doubt_below", &SearchModel::doubt_below, 0.0, 1.0),
  };
}

std::string textOf(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string faultsWith(const Limits& limits, double value) {
  ChainModel model;
  limits.set(model, value);
  std::string faults;
  for (const std::string& fault : faultsOf(model)) faults += fault + "\n";
  return faults;
}

TEST(FaultsOf, defaultsAreUsable) { EXPECT_TRUE(faultsOf(ChainModel()).empty()); }

TEST(FaultsOf, numbersAtTheirLimitsAreAllowed) {
  for (const Limits& limits : allLimits()) {
    EXPECT_EQ("", faultsWith(limits, limits.low));
    EXPECT_EQ("", faultsWith(limits, limits.high));
  }
}

TEST(FaultsOf, numbersBeyondTheirLimitsAreNamedWithValueAndRange) {
  for (const Limits& limits : allLimits()) {
    const double step = limits.whole ? 1.0 : 0.001 * (limits.high - limits.low);
    const std::string range = "[" + textOf(limits.low) + ", " + textOf(limits.high) + "]";
    for (double value : {limits.low - step, limits.high + step, -1000.0, 5000.0}) {
      EXPECT_EQ("", omissionsOf(faultsWith(limits, value), {limits.key, textOf(value), range}));
    }
  }
}

TEST(FaultsOf, numbersThatAreNoneOrInfiniteAreRefused) {
  for (const Limits& limits : allLimits()) {
    if (limits.whole) continue;
    for (double value : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
      EXPECT_EQ("", omissionsOf(faultsWith(limits, value), {limits.key, textOf(value)}));
    }
  }
}

TEST(FaultsOf, hypothesesMustHaveAMiddleOne) {
  ChainModel model;
  model.segments[0].orientation_hypotheses = 4;
  model.segments[0].scale_hypotheses = 2;
  const std::vector<std::string> faults = faultsOf(model);
  ASSERT_EQ(2U, faults.size());
  EXPECT_EQ("", omissionsOf(faults[0], {"segments[0]/orientation_hypotheses", "4", "odd"}));
  EXPECT_EQ("", omissionsOf(faults[1], {"segments[0]/scale_hypotheses", "2", "odd"}));
}

TEST(FaultsOf, namesMustNotBeEmpty) {
  ChainModel model;
  model.name = "";
  model.segments[0].name = "";
  const std::vector<std::string> faults = faultsOf(model);
  ASSERT_EQ(2U, faults.size());
  EXPECT_EQ("", omissionsOf(faults[0], {"name", "empty"}));
  EXPECT_EQ("", omissionsOf(faults[1], {"segments[0]/name", "empty"}));
}

TEST(FaultsOf, anObjectIsAFewSegments) {
  ChainModel model;
  model.segments.clear();
  ASSERT_EQ(1U, faultsOf(model).size());
  EXPECT_EQ("", omissionsOf(faultsOf(model)[0], {"segments", "0", "1 to 32"}));
  model.segments.resize(32);
  EXPECT_TRUE(faultsOf(model).empty());
  model.segments.resize(33);
  ASSERT_EQ(1U, faultsOf(model).size());
  EXPECT_EQ("", omissionsOf(faultsOf(model)[0], {"segments", "33", "1 to 32"}));
}

TEST(FaultsOf, thereIsAJointBetweenAnyTwoSegmentsOrNoneIsSaid) {
  ChainModel model;
  model.segments.resize(3);
  EXPECT_TRUE(faultsOf(model).empty());
  model.joints.resize(2);
  EXPECT_TRUE(faultsOf(model).empty());
  model.joints.resize(3);
  ASSERT_EQ(1U, faultsOf(model).size());
  EXPECT_EQ("", omissionsOf(faultsOf(model)[0], {"joints", "3", "one fewer", "2"}));
}

TEST(FaultsOf, jointsHaveOrderedLimits) {
  ChainModel model;
  model.segments.resize(2);
  model.joints = {{-0.5, 2.0}};
  EXPECT_TRUE(faultsOf(model).empty());
  model.joints = {{0.5, 0.2}};
  ASSERT_EQ(1U, faultsOf(model).size());
  EXPECT_EQ("", omissionsOf(faultsOf(model)[0], {"joints[0]/max_angle", "0.2", "[0.5, "}));
  model.joints = {{-4.0, 4.0}};
  ASSERT_EQ(2U, faultsOf(model).size());
  EXPECT_EQ("", omissionsOf(faultsOf(model)[0], {"joints[0]/min_angle", "-4"}));
  EXPECT_EQ("", omissionsOf(faultsOf(model)[1], {"joints[0]/max_angle", "4"}));
}

TEST(FaultsOf, oneSegmentStandsForEveryEdge) {
  ChainModel model;
  model.segment_per_edge = true;
  EXPECT_TRUE(faultsOf(model).empty());
  model.segments.resize(2);
  ASSERT_EQ(1U, faultsOf(model).size());
  EXPECT_EQ("", omissionsOf(faultsOf(model)[0], {"segments", "2", "must have 1"}));
  model.segments.resize(1);
  model.segments[0].layout = Layout::kPlanar;
  ASSERT_EQ(1U, faultsOf(model).size());
  EXPECT_EQ("", omissionsOf(faultsOf(model)[0], {"segments[0]/layout", "planar"}));
}

TEST(FaultsOf, onlyLinesCanBeJoined) {
  ChainModel model;
  model.segments.resize(2);
  model.segments[1].layout = Layout::kDeformable;
  EXPECT_TRUE(faultsOf(model).empty());
  model.segments[1].layout = Layout::kPlanar;
  ASSERT_EQ(1U, faultsOf(model).size());
  EXPECT_EQ("", omissionsOf(faultsOf(model)[0], {"segments[1]/layout", "planar", "elongated"}));
  model.segments[1].layout = Layout::kPoints;
  ASSERT_EQ(1U, faultsOf(model).size());
  EXPECT_EQ("", omissionsOf(faultsOf(model)[0], {"segments[1]/layout", "points", "elongated"}));
}

TEST(FaultsOf, onlyDeformableSegmentsHaveTheirWindowsMeasured) {
  ChainModel model;
  model.segments[0].measure_window = true;
  ASSERT_EQ(1U, faultsOf(model).size());
  EXPECT_EQ("", omissionsOf(faultsOf(model)[0], {"segments[0]/measure_window", "deformable"}));
  model.segments[0].layout = Layout::kDeformable;
  EXPECT_TRUE(faultsOf(model).empty());
}

TEST(FaultsOf, foundMustNotBeBelowLost) {
  ChainModel model;
  model.search.lost_below = model.search.found_above = 0.3;
  EXPECT_TRUE(faultsOf(model).empty());
  model.search.found_above = 0.2;
  ASSERT_EQ(1U, faultsOf(model).size());
  EXPECT_EQ("", omissionsOf(faultsOf(model)[0],
                            {"search/found_above", "0.2", "search/lost_below", "0.3"}));
}

TEST(FaultsOf, allFaultsAreToldAtOnce) {
  ChainModel model;
  model.name = "";
  model.segments[0].parts = 1;
  model.segments[0].window = 100.0;
  model.appearance.ring = -1.0;
  model.search.radius = 7.0;
  EXPECT_EQ(5U, faultsOf(model).size());
}

}  // namespace
}  // namespace chain_tracker
