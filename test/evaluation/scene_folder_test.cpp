// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/evaluation/scene_folder.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "../support/scene_probes.h"

namespace chain_tracker {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> linesOf(const fs::path& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

class SceneFolder : public testing::Test {
 protected:
  SceneFolder()
      : folder_(fs::path(testing::TempDir()) /
                (std::string("scene_folder_") +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
  }
  ~SceneFolder() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(SceneFolder, HoldsPicturesAndTruth) {
  SceneOptions options = cleanSceneOptions();
  options.frames = 3;
  const auto scene = makeScene("robot_arm", options);
  int done = 0;
  writeSceneFolder(*scene, options, folder_.string(), [&](int frames) { done = frames; });
  EXPECT_EQ(done, 3);
  const SceneFrame second = scene->render(1);
  EXPECT_TRUE(samePicture(second.image, cv::imread((folder_ / "img/000001.png").string())));
  EXPECT_FALSE(fs::exists(folder_ / "img/000003.png"));

  const std::vector<std::string> parts = linesOf(folder_ / "groundtruth_parts.csv");
  ASSERT_EQ(parts.size(), 1U + 3U * 4U);
  EXPECT_EQ(parts[0], "frame,part,x,y,visible");
  EXPECT_EQ(parts[1 + 4 + 2],
            cv::format("1,2,%.4f,%.4f,1", second.points[2].x, second.points[2].y));
  const std::vector<std::string> boxes = linesOf(folder_ / "groundtruth_rect.txt");
  ASSERT_EQ(boxes.size(), 3U);
  EXPECT_EQ(boxes[1], cv::format("%.4f,%.4f,%.4f,%.4f", second.box.x, second.box.y,
                                 second.box.width, second.box.height));
  const std::vector<std::string> segments = linesOf(folder_ / "groundtruth_segments.csv");
  ASSERT_EQ(segments.size(), 1U + 3U * 3U);
  EXPECT_EQ(segments[0], "frame,segment,x,y,theta,scale");
  const Similarity& forearm = second.segments[1];
  EXPECT_EQ(segments[1 + 3 + 1], cv::format("1,1,%.4f,%.4f,%.4f,%.4f", forearm.translation.x,
                                            forearm.translation.y, forearm.angle, forearm.scale));
  const std::vector<std::string> init = linesOf(folder_ / "init.yaml");
  ASSERT_EQ(init.size(), 3U);
  EXPECT_EQ(init[0], "model: " + scene->model());
  EXPECT_EQ(init[1].rfind("points: [[", 0), 0U) << init[1];
  EXPECT_EQ(init[2], "first_frame: 0");
}

TEST_F(SceneFolder, KeepsNoPicturesOfALongerScene) {
  SceneOptions options = cleanSceneOptions();
  options.size = {64, 64};
  for (const int frames : {5, 3}) {
    options.frames = frames;
    writeSceneFolder(*makeScene("bottle", options), options, folder_.string());
    std::ofstream(folder_ / "img" / "notes.txt") << "not of the scene";
  }
  EXPECT_TRUE(fs::exists(folder_ / "img/000002.png"));
  EXPECT_FALSE(fs::exists(folder_ / "img/000003.png"));
  EXPECT_FALSE(fs::exists(folder_ / "img/000004.png"));
  EXPECT_TRUE(fs::exists(folder_ / "img/notes.txt"));
}

TEST_F(SceneFolder, SaysWhenTheObjectIsAway) {
  SceneOptions options = cleanSceneOptions();
  options.frames = 43;
  options.leave_at = 41;
  options.leave_for = 5;
  writeSceneFolder(*makeScene("bottle", options), options, folder_.string());
  const std::vector<std::string> boxes = linesOf(folder_ / "groundtruth_rect.txt");
  ASSERT_EQ(boxes.size(), 43U);
  EXPECT_NE(boxes[0], "NaN,NaN,NaN,NaN");
  EXPECT_EQ(boxes[42], "NaN,NaN,NaN,NaN");
  const std::vector<std::string> parts = linesOf(folder_ / "groundtruth_parts.csv");
  EXPECT_EQ(parts.back().substr(parts.back().size() - 2), ",0");
}

TEST_F(SceneFolder, GreyPicturesHaveOneChannel) {
  SceneOptions options = cleanSceneOptions();
  options.frames = 1;
  options.grey = true;
  writeSceneFolder(*makeScene("suture", options), options, folder_.string());
  const cv::Mat image = cv::imread((folder_ / "img/000000.png").string(), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(image.channels(), 1);
}

TEST_F(SceneFolder, NamesWhatCannotBeWritten) {
  std::ofstream(folder_.string()) << "a file where the folder should be";
  SceneOptions options = cleanSceneOptions();
  options.frames = 1;
  try {
    writeSceneFolder(*makeScene("bottle", options), options, folder_.string());
    FAIL() << "was written into a file";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(folder_.string()), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace chain_tracker
