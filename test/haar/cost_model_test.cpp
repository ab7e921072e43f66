// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/haar/cost_model.h"

#include <cstdlib>

#include <gtest/gtest.h>

#include "chain_tracker/haar/shipped_ensembles.h"
#include "support/temporary_folder.h"

namespace chain_tracker::haar {
namespace {

const cv::Size kSize(96, 64);

PlanOptions quickOptions() {
  PlanOptions options;
  options.search_rounds = 0;
  options.exact_work = 0;
  return options;
}

const ConvolutionPlan& smallPlan() {
  static const FeatureEnsemble all = surfEnsemble();
  static const ConvolutionPlan plan(
      FeatureEnsemble("two", {all.features().begin(), all.features().begin() + 2}), quickOptions());
  return plan;
}

CostModelOptions optionsFor(const std::string& file, bool measure_anew = false) {
  CostModelOptions options;
  options.file = file;
  options.measure_anew = measure_anew;
  return options;
}

TEST(CostModel, predictsTimes) {
  CostModel model(kSize, optionsFor(""));
  EXPECT_GT(model.planSeconds(smallPlan()), 0.0);
  EXPECT_GT(model.classicSeconds(smallPlan()), 0.0);
  EXPECT_GT(model.speedUp(smallPlan()), 0.0);
}

TEST(CostModel, refusesEmptyImages) {
  EXPECT_THROW(CostModel({0, 4}, optionsFor("")), std::invalid_argument);
}

TEST(CostModel, measuresOnce) {
  const TemporaryFolder folder;
  CostModel first(kSize, optionsFor(folder.path("timings.yaml")));
  const double plan_seconds = first.planSeconds(smallPlan());
  const double classic_seconds = first.classicSeconds(smallPlan());
  EXPECT_GT(first.measuredLoops(), 0U);
  CostModel second(kSize, optionsFor(folder.path("timings.yaml")));
  EXPECT_EQ(second.planSeconds(smallPlan()), plan_seconds);
  EXPECT_EQ(second.classicSeconds(smallPlan()), classic_seconds);
  EXPECT_EQ(second.measuredLoops(), 0U);
}

TEST(CostModel, measuresEverySize) {
  const TemporaryFolder folder;
  CostModel(kSize, optionsFor(folder.path("timings.yaml"))).planSeconds(smallPlan());
  CostModel other({64, 96}, optionsFor(folder.path("timings.yaml")));
  other.planSeconds(smallPlan());
  EXPECT_GT(other.measuredLoops(), 0U);
}

TEST(CostModel, measuresAnewWhenAsked) {
  const TemporaryFolder folder;
  CostModel first(kSize, optionsFor(folder.path("timings.yaml")));
  first.speedUp(smallPlan());
  CostModel second(kSize, optionsFor(folder.path("timings.yaml"), true));
  second.speedUp(smallPlan());
  EXPECT_EQ(second.measuredLoops(), first.measuredLoops());
}

TEST(CostModel, measuresWhatTheFileDoesNotTell) {
  const TemporaryFolder folder;
  CostModel first(kSize, optionsFor(folder.path("timings.yaml")));
  first.speedUp(smallPlan());
  const std::string text = folder.read("timings.yaml");
  const std::string foreign = "machine: another" + text.substr(text.find('\n'));
  for (const std::string& damaged : {std::string("seconds: ["), foreign}) {
    folder.write("timings.yaml", damaged);
    CostModel second(kSize, optionsFor(folder.path("timings.yaml")));
    EXPECT_GT(second.speedUp(smallPlan()), 0.0);
    EXPECT_EQ(second.measuredLoops(), first.measuredLoops());
    EXPECT_NE(folder.read("timings.yaml"), damaged);
  }
}

TEST(CostModel, needsNoFile) {
  const TemporaryFolder folder;
  folder.write("file", "");
  CostModel model(kSize, optionsFor(folder.path("file/timings.yaml")));
  EXPECT_GT(model.speedUp(smallPlan()), 0.0);
}

TEST(CostModelFile, isInTheCacheOfTheUser) {
  ASSERT_EQ(setenv("HOME", "/home/someone", 1), 0);
  ASSERT_EQ(setenv("XDG_CACHE_HOME", "/caches", 1), 0);
  EXPECT_EQ(costModelFile(), "/caches/chain_tracker/haar_timings.yaml");
  ASSERT_EQ(setenv("XDG_CACHE_HOME", "relative", 1), 0);
  EXPECT_EQ(costModelFile(), "/home/someone/.cache/chain_tracker/haar_timings.yaml");
  ASSERT_EQ(unsetenv("XDG_CACHE_HOME"), 0);
  EXPECT_EQ(costModelFile(), "/home/someone/.cache/chain_tracker/haar_timings.yaml");
  ASSERT_EQ(unsetenv("HOME"), 0);
  EXPECT_EQ(costModelFile(), "");
}

}  // namespace
}  // namespace chain_tracker::haar
