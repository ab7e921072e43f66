// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/chain_model_io.h"

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <regex>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "support/model_difference.h"
#include "support/refusal.h"

namespace chain_tracker {
namespace {

const std::string kShippedModels = std::string(CHAIN_TRACKER_SOURCE_DIR) + "/config/models";
const std::string kBadModels = std::string(CHAIN_TRACKER_SOURCE_DIR) + "/test/data/models";

std::set<std::string> filesIn(const std::string& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

std::string parseRefusal(const std::string& yaml) {
  return refusalOf([&] { parseChainModel(yaml, "text.yaml"); });
}

/// Every key, none with the value it has by default.
const char kEveryKey[] = R"(
name: hose
segment_per_edge: false
segments:
  - name: tube
    layout: deformable
    parts: 17
    aspect: 0.2
    measure_aspect: true
    margin: 0.03
    window: 1.5
    measure_window: true
    stretch_sigma: 0.06
    bend_sigma: 0.25
    shape_memory: 0.75
    orientation_hypotheses: 7
    orientation_step: 0.125
    orientation_sigma: 0.2
    scale_hypotheses: 9
    scale_step: 0.04
    scale_sigma: 0.05
  - name: nozzle
joints:
  - min_angle: -0.5
    max_angle: 1.5
appearance:
  palette_colors: 31
  ring: 0.75
  min_object_share: 0.375
  weight: 5.5
  edge_weight: 7.5
  haar_weight: 2.25
  outlier_below: 0.375
  outlier_slope: 0.75
  light_rate: 0.625
search:
  radius: 0.09
  lost_below: 0.125
  found_above: 0.625
  lost_share: 0.1875
  occluded_below: 0.3
  travel_weight: 0.625
  doubt_below: 0.875
)";

ChainModel everyKeyModel() {
  ChainModel model;
  model.name = "hose";
  SegmentModel& segment = model.segments[0];
  segment.name = "tube";
  segment.layout = Layout::kDeformable;
  segment.parts = 17;
  segment.aspect = 0.2;
  segment.measure_aspect = true;
  segment.margin = 0.03;
  segment.window = 1.5;
  segment.measure_window = true;
  segment.stretch_sigma = 0.06;
  segment.bend_sigma = 0.25;
  segment.shape_memory = 0.75;
  segment.orientation_hypotheses = 7;
  segment.orientation_step = 0.125;
  segment.orientation_sigma = 0.2;
  segment.scale_hypotheses = 9;
  segment.scale_step = 0.04;
  segment.scale_sigma = 0.05;
  model.segments.emplace_back();
  model.segments[1].name = "nozzle";
  model.joints = {{-0.5, 1.5}};
  model.appearance = {31, 0.75, 0.375, 5.5, 7.5, 2.25, 0.375, 0.75, 0.625};
  model.search = {0.09, 0.125, 0.625, 0.1875, 0.3, 0.625, 0.875};
  return model;
}

TEST(ParseChainModel, readsEveryKey) {
  EXPECT_EQ("", differencesOf(everyKeyModel(), parseChainModel(kEveryKey, "text.yaml")));
}

/// The refusal of an unknown key lists the known ones: none may be missing above.
TEST(ParseChainModel, noKeyIsUntested) {
  const std::vector<std::string> places = {"zzz: 1", "segments: [{zzz: 1}]", "appearance: {zzz: 1}",
                                           "search: {zzz: 1}", "joints: [{zzz: 1}]"};
  size_t keys = 0;
  for (const std::string& place : places) {
    std::string refusal = parseRefusal(place);
    const size_t list = refusal.find("must be one of: ");
    ASSERT_NE(std::string::npos, list) << refusal;
    refusal = refusal.substr(list + std::string("must be one of: ").size()) + ", ";
    for (size_t end; (end = refusal.find(", ")) != std::string::npos;) {
      const std::string key = refusal.substr(0, end);
      const std::regex in_yaml("[ \\n]" + key + ":");
      EXPECT_TRUE(std::regex_search(kEveryKey, in_yaml)) << key << " is not tested";
      refusal = refusal.substr(end + 2);
      ++keys;
    }
  }
  EXPECT_EQ(41U, keys);
}

TEST(ParseChainModel, keysLeftOutKeepTheirDefaults) {
  ChainModel expected;
  EXPECT_EQ("", differencesOf(expected, parseChainModel("{}", "text.yaml")));
  expected.search.radius = 0.2;
  EXPECT_EQ("", differencesOf(expected, parseChainModel("search: {radius: 0.2}", "text.yaml")));
  expected = ChainModel();
  expected.segments[0].layout = Layout::kPlanar;
  EXPECT_EQ("", differencesOf(expected, parseChainModel("segments: [{layout: planar}]", "t.yaml")));
}

TEST(ParseChainModel, readsEveryLayout) {
  const auto layout = [](const std::string& name) {
    return parseChainModel("segments: [{layout: " + name + "}]", "text.yaml").segments[0].layout;
  };
  EXPECT_EQ(Layout::kElongated, layout("elongated"));
  EXPECT_EQ(Layout::kPlanar, layout("planar"));
  EXPECT_EQ(Layout::kDeformable, layout("deformable"));
  EXPECT_EQ(Layout::kPoints, layout("points"));
}

TEST(ParseChainModel, tellsAllFaultsOfRangeAtOnce) {
  const std::string refusal = parseRefusal(
      "segments:\n  - parts: 1\n    window: 99\nappearance:\n  ring: -2\nsearch:\n  radius: 0\n");
  EXPECT_EQ("", omissionsOf(refusal, {"segments[0]/parts", "segments[0]/window", "appearance/ring",
                                      "search/radius"}));
  EXPECT_EQ(3, std::count(refusal.begin(), refusal.end(), '\n')) << "a line for each";
}

struct BadModel {
  std::string file;
  int line;                        ///< of the fault, from 1
  std::vector<std::string> texts;  ///< that the refusal must contain
};

std::ostream& operator<<(std::ostream& out, const BadModel& model) { return out << model.file; }

std::vector<BadModel> badModels() {
  return {
      {"not_yaml.yaml", 4, {"not valid YAML"}},
      {"empty.yaml", 1, {"must be a map"}},
      {"not_a_map.yaml", 2, {"must be a map"}},
      {"unknown_key.yaml", 5, {"segments[0]", "'window_size'", "stretch_sigma, window"}},
      {"unknown_section.yaml", 3, {"'apearance'", "appearance, "}},
      {"word_for_number.yaml", 3, {"appearance/weight", "'heavy'", "a number"}},
      {"unit_after_number.yaml", 3, {"segments[0]/bend_sigma", "'0.1rad'", "a number"}},
      {"fraction_for_count.yaml", 4, {"segments[0]/parts", "'12.5'", "a whole number"}},
      {"list_for_number.yaml", 3, {"search/radius", "[0.1, 0.2]", "a number"}},
      {"missing_number.yaml", 4, {"segments[0]/aspect", "a number"}},
      {"missing_name.yaml", 2, {"name", "text"}},
      {"empty_name.yaml", 3, {"segments[0]/name", "empty"}},
      {"unknown_layout.yaml",
       4,
       {"segments[0]/layout", "'round'", "deformable, elongated, planar"}},
      {"negative_size.yaml", 4, {"segments[0]/aspect", "-0.4", "[0.001, 1]"}},
      {"even_hypotheses.yaml", 3, {"segments[0]/orientation_hypotheses", "4", "odd"}},
      {"weight_not_a_number.yaml", 3, {"appearance/weight", "nan", "[0.1, 1000]"}},
      {"huge_count.yaml", 3, {"segments[0]/parts", "99999999999"}},
      {"duplicate_key.yaml", 6, {"segments[0]", "parts"}},
      {"duplicate_section.yaml", 6, {"search"}},
      {"joints_without_segments.yaml", 3, {"joints", "2", "one fewer"}},
      {"no_segments.yaml", 2, {"segments", "0", "1 to 32"}},
      {"segments_not_a_list.yaml", 2, {"segments", "must be a list"}},
      {"appearance_not_a_map.yaml", 2, {"appearance", "must be a map"}},
      {"crossed_thresholds.yaml", 4, {"search/found_above", "0.4", "search/lost_below", "0.5"}},
      {"two_documents.yaml", 3, {"second", "document"}},
  };
}

class BadModelFile : public ::testing::TestWithParam<BadModel> {};

TEST_P(BadModelFile, isRefusedWithFileLineKeyAndValue) {
  const std::string path = kBadModels + "/" + GetParam().file;
  const std::string refusal = refusalOf([&] { loadChainModel(path); });
  EXPECT_EQ("", omissionsOf(refusal, GetParam().texts));
  EXPECT_EQ("", omissionsOf(refusal, {path + ":" + std::to_string(GetParam().line) + ":"}));
}

std::string testName(const ::testing::TestParamInfo<BadModel>& info) {
  return info.param.file.substr(0, info.param.file.find('.'));
}

INSTANTIATE_TEST_SUITE_P(All, BadModelFile, ::testing::ValuesIn(badModels()), testName);

TEST(BadModelFiles, areAllTested) {
  std::set<std::string> tested;
  for (const BadModel& model : badModels()) tested.insert(model.file);
  EXPECT_EQ(filesIn(kBadModels), tested);
}

TEST(LoadChainModel, namesAFileThatIsNotThere) {
  const std::string path = kBadModels + "/no_such_model.yaml";
  EXPECT_EQ("", omissionsOf(refusalOf([&] { loadChainModel(path); }), {path, "cannot be read"}));
}

TEST(LoadChainModel, tellsWhereItLookedForAFile) {
  const std::string path = (std::filesystem::current_path() / "no_such_model.yaml").string();
  EXPECT_EQ("", omissionsOf(refusalOf([] { loadChainModel("no_such_model.yaml"); }), {path}));
}

TEST(LoadChainModel, namesAFolderThatIsNoFile) {
  EXPECT_EQ("", omissionsOf(refusalOf([&] { loadChainModel(kBadModels); }), {kBadModels}));
}

TEST(ShippedModels, loadAndBearTheirFilesNames) {
  const std::set<std::string> files = filesIn(kShippedModels);
  ASSERT_GE(files.size(), 3U);
  for (const std::string& file : files) {
    SCOPED_TRACE(file);
    const ChainModel model = loadChainModel(kShippedModels + "/" + file);
    EXPECT_EQ(std::filesystem::path(file).stem().string(), model.name);
  }
}

/// bottle.yaml is the page where every key is explained: it shows the defaults.
TEST(ShippedModels, bottleIsTheDefault) {
  EXPECT_EQ("", differencesOf(ChainModel(), loadChainModel(kShippedModels + "/bottle.yaml")));
}

TEST(ShippedModels, boxIsNearlyTheDefaultOnAPlane) {
  ChainModel expected;
  expected.name = "box";
  expected.segments[0].name = "face";
  expected.segments[0].layout = Layout::kPlanar;
  expected.segments[0].parts = 30;
  expected.segments[0].scale_sigma = 0.02;
  expected.search.radius = 0.1;
  EXPECT_EQ("", differencesOf(expected, loadChainModel(kShippedModels + "/box.yaml")));
}

TEST(ShippedModels, cableBendsAndIsSearchedUnderOnePose) {
  ChainModel expected;
  expected.name = "cable";
  SegmentModel& segment = expected.segments[0];
  segment.name = "cable";
  segment.layout = Layout::kDeformable;
  segment.parts = 48;
  segment.aspect = 0.01;
  segment.window = 1.0;
  segment.measure_window = true;
  segment.orientation_hypotheses = 1;
  segment.scale_hypotheses = 1;
  expected.appearance.light_rate = 0.0;
  EXPECT_EQ("", differencesOf(expected, loadChainModel(kShippedModels + "/cable.yaml")));
}

TEST(ShippedModels, articulatedHasALinkForEveryEdge) {
  ChainModel expected;
  expected.name = "articulated";
  expected.segment_per_edge = true;
  SegmentModel& segment = expected.segments[0];
  segment.name = "link";
  segment.parts = 8;
  segment.aspect = 0.28;
  segment.measure_aspect = true;
  segment.margin = 0.0;
  segment.scale_hypotheses = 1;
  segment.scale_step = 0.02;
  expected.appearance.light_rate = 0.1;
  EXPECT_EQ("", differencesOf(expected, loadChainModel(kShippedModels + "/articulated.yaml")));
}

TEST(ParseChainModel, readsSegmentPerEdge) {
  EXPECT_TRUE(parseChainModel("segment_per_edge: true", "t.yaml").segment_per_edge);
  EXPECT_EQ("", omissionsOf(parseRefusal("segment_per_edge: 3"),
                            {"text.yaml:1", "segment_per_edge", "'3'", "true or false"}));
}

}  // namespace
}  // namespace chain_tracker
