// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/evaluation/ground_truth.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "../support/refusal.h"

namespace chain_tracker {
namespace {

namespace fs = std::filesystem;

class GroundTruthFiles : public testing::Test {
 protected:
  GroundTruthFiles()
      : folder_(fs::path(testing::TempDir()) /
                (std::string("ground_truth_") +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~GroundTruthFiles() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& content) const {
    const std::string path = (folder_ / name).string();
    std::ofstream(path) << content;
    return path;
  }

  GroundTruth boxesIn(const std::string& content) const {
    GroundTruth truth;
    readBoxes(write("groundtruth_rect.txt", content), truth);
    return truth;
  }

  GroundTruth pointsIn(const std::string& content) const {
    GroundTruth truth;
    readPoints(write("groundtruth_parts.csv", content), truth);
    return truth;
  }

  SequenceStart startIn(const std::string& init) const {
    write("init.yaml", init);
    return readStart(folder_.string(), GroundTruth()).value();
  }

  void expectInitRefusal(const std::string& init, const std::string& reason) const {
    const std::string place = (folder_ / "init.yaml").string();
    EXPECT_EQ(omissionsOf(refusalOf([&] { startIn(init); }), {place + reason}), "") << init;
  }

  fs::path folder_;
};

TEST_F(GroundTruthFiles, BoxesMayBeSeparatedByCommasTabsOrSpaces) {
  const GroundTruth truth = boxesIn("1,2,30,40\n1\t2\t30\t40\r\n1 2  30 40\n1, 2, 30, 40\n");
  ASSERT_EQ(truth.boxes.size(), 4U);
  for (const auto& [frame, box] : truth.boxes) {
    EXPECT_EQ(box, cv::Rect2d(1, 2, 30, 40)) << "frame " << frame;
  }
  EXPECT_TRUE(truth.polygons.empty());
}

TEST_F(GroundTruthFiles, PolygonsBecomeTheirUprightBoxes) {
  const GroundTruth truth = boxesIn("10,0,20,10,10,20,0,10\n5,6,7,8\n");
  EXPECT_EQ(truth.boxes.at(0), cv::Rect2d(0, 0, 20, 20));
  EXPECT_EQ(truth.boxes.at(1), cv::Rect2d(5, 6, 7, 8));
  ASSERT_EQ(truth.polygons.size(), 1U);
  ASSERT_EQ(truth.polygons.at(0).size(), 4U);
  EXPECT_EQ(truth.polygons.at(0)[1], cv::Point2d(20, 10));
}

TEST_F(GroundTruthFiles, BoxesTurnIfAnyIsGivenByTurnedCorners) {
  const std::string upright = "10,10,30,10,30,50,10,50\n";
  EXPECT_TRUE(boxesIn(upright + "12,10,32,14,28,54,8,50\n").boxes_turn);
  EXPECT_FALSE(boxesIn(upright + "10,10,31,11,30,50,10,51\n").boxes_turn) << "whole pixels";
  EXPECT_FALSE(boxesIn("1,2,30,40\n").boxes_turn);
}

TEST_F(GroundTruthFiles, NanOrAnEmptyBoxSaysThatThereIsNoObject) {
  const GroundTruth truth = boxesIn("1,2,30,40\nNaN,NaN,NaN,NaN\nnan 2 3 4\n0,0,0,0\n5,6,7,8\n");
  ASSERT_EQ(truth.boxes.size(), 5U);
  for (const int frame : {1, 2, 3}) EXPECT_FALSE(truth.boxes.at(frame)) << "frame " << frame;
  EXPECT_EQ(truth.boxes.at(4), cv::Rect2d(5, 6, 7, 8));
}

TEST_F(GroundTruthFiles, FaultyBoxesAreNamedByFileAndLine) {
  const std::string place = (folder_ / "groundtruth_rect.txt").string();
  EXPECT_EQ(omissionsOf(refusalOf([&] { boxesIn("1,2,3,4\n1,2,3\n"); }),
                        {place + ":2: has 3 numbers, must be x,y,w,h"}),
            "");
  EXPECT_EQ(omissionsOf(refusalOf([&] { boxesIn("1,2,3,4\n1,2,x,4\n"); }),
                        {place + ":2: '1,2,x,4' has something"}),
            "");
  for (const std::string line : {"1,2,inf,4", "-inf,2,3,4", "0,0,9,0,9,1e999,0,9"}) {
    EXPECT_EQ(omissionsOf(refusalOf([&] { boxesIn("1,2,3,4\n" + line + "\n"); }),
                          {place + ":2: '" + line + "' has an infinite number"}),
              "");
  }
  GroundTruth truth;
  EXPECT_EQ(omissionsOf(refusalOf([&] { readBoxes("/no/such.txt", truth); }),
                        {"ground truth /no/such.txt cannot be read"}),
            "");
}

TEST_F(GroundTruthFiles, ABlankLineWouldShiftTheBoxesBehindIt) {
  const std::string place = (folder_ / "groundtruth_rect.txt").string();
  EXPECT_EQ(omissionsOf(refusalOf([&] { boxesIn("1,2,3,4\n\n \r\n5,6,7,8\n"); }),
                        {place + ":2: is blank, write NaN,NaN,NaN,NaN where there is no object"}),
            "");
  EXPECT_EQ(boxesIn("1,2,3,4\n5,6,7,8\n\n\n").boxes.size(), 2U) << "nothing lies behind it";
}

TEST_F(GroundTruthFiles, PointsByFrameAndPart) {
  const GroundTruth truth =
      pointsIn("frame,part,x,y,visible\n0,0,1.5,2.5,1\n0,1,3,4,0\n2,0,nan,nan,1\n2,1,5,6,1\n");
  ASSERT_EQ(truth.points.size(), 2U);
  EXPECT_EQ(truth.points.at(0).at(0).position, cv::Point2d(1.5, 2.5));
  EXPECT_TRUE(truth.points.at(0).at(0).visible);
  EXPECT_FALSE(truth.points.at(0).at(1).visible);
  EXPECT_EQ(truth.points.at(2).count(0), 0U) << "NaN: not known";
  EXPECT_EQ(truth.points.at(2).at(1).position, cv::Point2d(5, 6));
}

TEST_F(GroundTruthFiles, FaultyPointsAreNamedByFileAndLine) {
  const std::string place = (folder_ / "groundtruth_parts.csv").string();
  const std::string header = "frame,part,x,y,visible\n";
  EXPECT_EQ(
      omissionsOf(refusalOf([&] { pointsIn(""); }), {place + ":1: is '', must be the header"}), "");
  EXPECT_EQ(omissionsOf(refusalOf([&] { pointsIn("0,0,1,2,1\n"); }),
                        {place + ":1: is '0,0,1,2,1', must be the header"}),
            "");
  EXPECT_EQ(omissionsOf(refusalOf([&] { pointsIn(header + "0,0,1,2\n"); }),
                        {place + ":2: has 4 numbers, must have 5"}),
            "");
  EXPECT_EQ(omissionsOf(refusalOf([&] { pointsIn(header + "0,0,1,2,1\n0,1,a,2,1\n"); }),
                        {place + ":3: '0,1,a,2,1' has"}),
            "");
  EXPECT_EQ(omissionsOf(refusalOf([&] { pointsIn(header + "0,0,1,inf,1\n"); }),
                        {place + ":2: '0,0,1,inf,1' has an infinite number"}),
            "");
  for (const std::string index : {"-1", "0.5", "inf", "1e+300", "nan"}) {
    EXPECT_EQ(omissionsOf(refusalOf([&] { pointsIn(header + index + ",0,1,2,1\n"); }),
                          {place + ":2: frame is " + index, "must be a whole number in [0, "}),
              "");
    EXPECT_EQ(omissionsOf(refusalOf([&] { pointsIn(header + "0," + index + ",1,2,1\n"); }),
                          {place + ":2: part is " + index, "must be a whole number in [0, "}),
              "");
  }
}

TEST_F(GroundTruthFiles, AFolderMayHaveEitherFileBothOrNone) {
  EXPECT_TRUE(readGroundTruth(folder_.string()).empty());
  write("groundtruth_rect.txt", "1,2,3,4\n");
  EXPECT_EQ(readGroundTruth(folder_.string()).boxes.size(), 1U);
  write("groundtruth_parts.csv", "frame,part,x,y,visible\n0,0,1,2,1\n");
  const GroundTruth both = readGroundTruth(folder_.string());
  EXPECT_EQ(both.boxes.size(), 1U);
  EXPECT_EQ(both.points.size(), 1U);
}

TEST_F(GroundTruthFiles, InitSaysModelPointsAndFrame) {
  const SequenceStart start = startIn("model: cable\npoints: [[1, 2], [3.5, 4]]\nfirst_frame: 7\n");
  EXPECT_EQ(start.model, "cable");
  EXPECT_EQ(start.points, (std::vector<cv::Point2d>{{1, 2}, {3.5, 4}}));
  EXPECT_EQ(start.first_frame, 7);
}

TEST_F(GroundTruthFiles, FaultyInitIsNamedByFileAndLine) {
  const std::string place = (folder_ / "init.yaml").string();
  EXPECT_EQ(omissionsOf(refusalOf([&] { startIn("model: box\npionts: []\n"); }),
                        {place + ":2: unknown key 'pionts'"}),
            "");
  EXPECT_EQ(omissionsOf(refusalOf([&] { startIn("points:\n  - [1, 2]\n  - [1, 2, 3]\n"); }),
                        {place + ":3: a point must be"}),
            "");
  EXPECT_EQ(
      omissionsOf(refusalOf([&] { startIn("model: box\nfirst_frame: soon\n"); }), {place + ":2: "}),
      "");
  EXPECT_EQ(omissionsOf(refusalOf([&] { startIn("points: [[1, x]]\n"); }), {place + ":1: "}), "");
  EXPECT_EQ(omissionsOf(refusalOf([&] { startIn("model: [box\n"); }), {place + ":"}), "");
  EXPECT_EQ(omissionsOf(refusalOf([&] { startIn("first_frame: -3\n"); }),
                        {place + ":1: first_frame is -3"}),
            "");
}

TEST_F(GroundTruthFiles, WhatInitSaysIsNeverPassedOver) {
  for (const std::string points : {"10,20,30,40", "", "{x: 1}"}) {
    expectInitRefusal("model: box\npoints: " + points + "\n",
                      ":2: points must be a list [[x, y], ...]");
  }
  for (const std::string document : {"cable\n", "- model\n"}) {
    expectInitRefusal(document, ":1: must be a map of the keys first_frame, model, points");
  }
  expectInitRefusal("model: box\nmodel: cable\n", ":2: key 'model' is there twice");
  write("init.yaml", "# nothing yet\n");
  EXPECT_FALSE(readStart(folder_.string(), GroundTruth())) << "it says nothing";
}

TEST_F(GroundTruthFiles, ValuesOfInitAreNamedByTheirKeys) {
  expectInitRefusal("first_frame: 1.5\n", ":1: first_frame is '1.5', must be a whole number");
  expectInitRefusal("model: [box]\n", ":1: model is '[box]', must be text");
  expectInitRefusal("points: [[1, x]]\n", ":1: a coordinate of points is 'x', must be a number");
  expectInitRefusal("[model]: box\n", ":1: a key is '[model]', must be text");
}

TEST_F(GroundTruthFiles, WithoutInitTheFirstTruthStarts) {
  EXPECT_FALSE(readStart(folder_.string(), GroundTruth()));
  const auto box = readStart(folder_.string(), boxesIn("nan,nan,nan,nan\n1,2,30,40\n"));
  ASSERT_TRUE(box);
  EXPECT_EQ(box->first_frame, 1);
  EXPECT_EQ(box->model, "auto");
  EXPECT_EQ(box->points, (std::vector<cv::Point2d>{{1, 2}, {31, 2}, {31, 42}, {1, 42}}));
  const auto polygon =
      readStart(folder_.string(), boxesIn("nan,nan,nan,nan\n10,0,20,10,10,20,0,10\n"));
  EXPECT_EQ(polygon->points, (std::vector<cv::Point2d>{{10, 0}, {20, 10}, {10, 20}, {0, 10}}));
  const auto points =
      readStart(folder_.string(), pointsIn("frame,part,x,y,visible\n3,0,1,2,1\n3,1,5,6,1\n"));
  EXPECT_EQ(points->first_frame, 3);
  EXPECT_EQ(points->points, (std::vector<cv::Point2d>{{1, 2}, {5, 6}}));
}

TEST_F(GroundTruthFiles, PartsStartInTheFirstFrameThatHasThemAll) {
  GroundTruth truth = pointsIn(
      "frame,part,x,y,visible\n2,0,1,1,1\n2,2,3,3,1\n3,0,nan,nan,0\n3,1,2,2,1\n3,2,3,3,1\n"
      "4,0,4,4,1\n4,1,5,5,0\n4,2,6,6,1\n");
  EXPECT_EQ(partCount(truth), 3U);
  const auto start = readStart(folder_.string(), truth);
  ASSERT_TRUE(start);
  EXPECT_EQ(start->first_frame, 4);
  EXPECT_EQ(start->points, (std::vector<cv::Point2d>{{4, 4}, {5, 5}, {6, 6}}));
  truth.points.erase(4);
  truth.boxes[2] = cv::Rect2d(1, 2, 30, 40);
  EXPECT_FALSE(readStart(folder_.string(), truth)) << "corners are no parts";
}

TEST_F(GroundTruthFiles, PartsStartWhereAllAreSeenIfTheyEverAre) {
  const auto start = readStart(
      folder_.string(), pointsIn("frame,part,x,y,visible\n0,0,1,1,1\n0,1,-1,-1,0\n1,0,2,2,1\n"
                                 "1,1,3,3,1\n2,0,4,4,1\n2,1,5,5,1\n"));
  ASSERT_TRUE(start);
  EXPECT_EQ(start->first_frame, 1);
  EXPECT_EQ(start->points, (std::vector<cv::Point2d>{{2, 2}, {3, 3}}));
}

TEST_F(GroundTruthFiles, InitWithoutPointsLeavesThemToTheTruth) {
  write("init.yaml", "model: cable\n");
  const auto start = readStart(folder_.string(), boxesIn("1,2,30,40\n"));
  EXPECT_EQ(start->model, "cable");
  EXPECT_EQ(start->points.size(), 4U);
}

TEST_F(GroundTruthFiles, ModelFilesOfInitLieInItsFolder) {
  write("init.yaml", "model: mine.yaml\n");
  EXPECT_EQ(readStart(folder_.string(), boxesIn("1,2,30,40\n"))->model,
            (folder_ / "mine.yaml").string());
  write("init.yaml", "model: /models/mine.yaml\n");
  EXPECT_EQ(readStart(folder_.string(), boxesIn("1,2,30,40\n"))->model, "/models/mine.yaml");
}

TEST_F(GroundTruthFiles, InitWithoutPointsMaySayTheirFrame) {
  write("init.yaml", "model: cable\nfirst_frame: 1\n");
  const std::string folder = folder_.string();
  const auto box = readStart(folder, boxesIn("1,2,30,40\n5,6,30,40\n"));
  EXPECT_EQ(box->first_frame, 1);
  EXPECT_EQ(box->points.front(), cv::Point2d(5, 6));
  const auto parts = readStart(
      folder, pointsIn("frame,part,x,y,visible\n0,0,1,2,1\n0,1,3,4,1\n1,0,5,6,1\n1,1,7,8,1\n"));
  EXPECT_EQ(parts->first_frame, 1);
  EXPECT_EQ(parts->points, (std::vector<cv::Point2d>{{5, 6}, {7, 8}}));
}

TEST_F(GroundTruthFiles, TheFrameThatInitSaysMustHaveTruth) {
  write("init.yaml", "model: cable\nfirst_frame: 1\n");
  const std::string place = (folder_ / "init.yaml").string() + ":2: first_frame is 1, must be ";
  const auto start = [&](const GroundTruth& truth) { readStart(folder_.string(), truth); };
  EXPECT_EQ(omissionsOf(refusalOf([&] { start(boxesIn("1,2,30,40\nnan,nan,nan,nan\n")); }),
                        {place + "a frame with a box of the ground truth"}),
            "");
  EXPECT_EQ(
      omissionsOf(refusalOf([&] {
                    start(pointsIn("frame,part,x,y,visible\n0,0,1,2,1\n0,1,3,4,1\n1,1,7,8,1\n"));
                  }),
                  {place + "a frame with all the 2 parts of the ground truth"}),
      "");
  EXPECT_FALSE(readStart(folder_.string(), GroundTruth())) << "there may be --points";
}

}  // namespace
}  // namespace chain_tracker
