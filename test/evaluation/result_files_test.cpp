// SPDX-License-Identifier: BSD-3-Clause
#include "tools/common/result_files.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

auto countFields(const std::string& line) { return std::count(line.begin(), line.end(), ','); }

ObjectRow makeRow(double time_ms, const std::string& state, double confidence) {
  ObjectRow row;
  row.time_ms = time_ms;
  row.state = state;
  row.confidence = confidence;
  return row;
}

TEST(ResultFiles, linesHaveTheFieldsOfTheirHeaders) {
  EXPECT_EQ(countFields(kObjectHeader), countFields(toCsv(makeRow(1.0, "LOST", 0.0))));
  EXPECT_EQ(countFields(kPartHeader), countFields(toCsv(PartRow())));
  EXPECT_EQ(countFields(kPointHeader), countFields(toCsv(PointRow())));
}

TEST(ResultFiles, objectLine) {
  ObjectRow row = makeRow(2.5, "TRACKING", 0.75);
  row.frame = 7;
  row.x = 10.25;
  row.y = -1.5;
  row.w = 30.0;
  row.h = 40.0;
  row.theta = -0.5;
  row.scale = 1.125;
  EXPECT_EQ("7,2.500,TRACKING,0.7500,10.25,-1.50,30.00,40.00,-0.50000,1.12500", toCsv(row));
}

TEST(ResultFiles, missingValuesAreNan) {
  PointRow row;
  row.x = row.y = kNan;
  EXPECT_EQ("0,0,nan,nan,0.0000,0", toCsv(row));
}

TEST(RunSummary, countsLostFramesAndAveragesTheOthers) {
  RunSummary summary;
  summary.add(makeRow(10.0, "INITIALIZING", 1.0));
  summary.add(makeRow(20.0, "TRACKING", 0.8));
  summary.add(makeRow(20.0, "OCCLUDED", 0.6));
  summary.add(makeRow(30.0, "LOST", 0.1));
  const nlohmann::json json = summary.toJson();
  EXPECT_EQ(4, json["frames"]);
  EXPECT_EQ(1, json["lost_frames"]);
  EXPECT_DOUBLE_EQ(0.75, json["tracked_share"].get<double>());
  EXPECT_DOUBLE_EQ(0.8, json["mean_confidence"].get<double>());
  EXPECT_DOUBLE_EQ(50.0, json["fps"].get<double>());
  EXPECT_DOUBLE_EQ(20.0, json["latency_ms"]["p50"].get<double>());
  EXPECT_EQ(1, json["states"]["OCCLUDED"]);
}

TEST(RunSummary, withoutFramesSaysNullNotZero) {
  const std::string text = RunSummary().toJson().dump();
  EXPECT_NE(std::string::npos, text.find("\"tracked_share\":null")) << text;
  EXPECT_NE(std::string::npos, text.find("\"fps\":null")) << text;
}

}  // namespace
}  // namespace chain_tracker
