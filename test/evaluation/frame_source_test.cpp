// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/evaluation/frame_source.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "../support/refusal.h"

namespace chain_tracker {
namespace {

namespace fs = std::filesystem;

class FrameSources : public testing::Test {
 protected:
  FrameSources()
      : folder_(fs::path(testing::TempDir()) /
                (std::string("frame_source_") +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "img");
  }
  ~FrameSources() override { fs::remove_all(folder_); }

  static cv::Mat picture(int level) { return cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(level)); }

  void writePicture(const std::string& name, int level) const {
    ASSERT_TRUE(cv::imwrite((folder_ / "img" / name).string(), picture(level)));
  }

  /// Three frames of the levels 50, 100 and 150, 10 a second.
  std::string writeVideo(const std::string& name) const {
    const std::string path = (folder_ / name).string();
    cv::VideoWriter writer(path, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10.0, {64, 48});
    EXPECT_TRUE(writer.isOpened());
    for (const int level : {50, 100, 150}) writer.write(picture(level));
    return path;
  }

  /// Twenty noisy frames of the levels 0, 10, ..., 190, of whose bytes those from 0.4 to 0.6 of the
  /// file are overwritten.
  std::string writeDamagedVideo(const std::string& name, const std::string& codec) const {
    std::string path = (folder_ / name).string();
    {
      const int fourcc = cv::VideoWriter::fourcc(codec[0], codec[1], codec[2], codec[3]);
      cv::VideoWriter writer(path, fourcc, 10.0, {64, 48});
      EXPECT_TRUE(writer.isOpened());
      cv::RNG rng(1);
      for (int level = 0; level < 200; level += 10) {
        cv::Mat noise(48, 64, CV_8UC3);
        rng.fill(noise, cv::RNG::UNIFORM, 0, 60);
        writer.write(noise + cv::Scalar::all(level - 30));
      }
    }
    const auto size = static_cast<std::streamoff>(fs::file_size(path));
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(size * 4 / 10);
    file << std::string(static_cast<std::size_t>(size / 5), '\xff');
    return path;
  }

  static std::vector<SourceFrame> all(const std::string& path) {
    const auto source = openFrames(path);
    std::vector<SourceFrame> frames;
    SourceFrame frame;
    while (source->next(frame)) frames.push_back(frame);
    return frames;
  }

  static double levelOf(const SourceFrame& frame) { return cv::mean(frame.image)[0]; }

  fs::path folder_;
};

TEST_F(FrameSources, PicturesComeInTheOrderOfTheirNames) {
  writePicture("0002.png", 20);
  writePicture("0001.bmp", 10);
  writePicture("0010.jpg", 100);
  std::ofstream(folder_ / "img" / "notes.txt") << "no picture";
  const std::vector<SourceFrame> frames = all(folder_.string());
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_NEAR(levelOf(frames[0]), 10, 1);
  EXPECT_NEAR(levelOf(frames[1]), 20, 1);
  EXPECT_NEAR(levelOf(frames[2]), 100, 2);
  EXPECT_EQ(frames[2].index, 2);
  EXPECT_NEAR(frames[2].time_sec, 2.0 / 30.0, 1e-9);
  EXPECT_EQ(openFrames(folder_.string())->count(), 3);
}

TEST_F(FrameSources, NumbersInNamesCountByTheirValue) {
  for (const int number : {1, 2, 9, 10, 11, 100}) {
    writePicture("take2_" + std::to_string(number) + ".png", number);
  }
  writePicture("take10_1.png", 200);
  std::vector<int> levels;
  for (const SourceFrame& frame : all(folder_.string())) levels.push_back(cvRound(levelOf(frame)));
  EXPECT_EQ(levels, (std::vector<int>{1, 2, 9, 10, 11, 100, 200}));
}

TEST_F(FrameSources, EndingsMayBeInUpperCase) {
  writePicture("1.PNG", 10);
  writePicture("2.JPG", 20);
  fs::create_directories(folder_ / "img" / "3.png");
  EXPECT_EQ(all(folder_.string()).size(), 2U) << "a folder is no picture";
}

TEST_F(FrameSources, PicturesAndVideosTellTheirRate) {
  EXPECT_NEAR(openFrames(writeVideo("clip.avi"))->rate(), 10.0, 1e-6);
  writePicture("0.png", 10);
  EXPECT_EQ(openFrames(folder_.string())->rate(), 30.0);
  EXPECT_EQ(greyFrames(openFrames(folder_.string()))->rate(), 30.0);
}

TEST_F(FrameSources, AnUnreadablePictureIsAFrameWithAFault) {
  writePicture("0.png", 10);
  std::ofstream(folder_ / "img" / "1.png") << "no picture";
  writePicture("2.png", 20);
  const std::vector<SourceFrame> frames = all(folder_.string());
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_TRUE(frames[1].image.empty());
  EXPECT_EQ(frames[1].index, 1);
  EXPECT_EQ(frames[1].fault, (folder_ / "img/1.png").string() + " cannot be read as an image");
  EXPECT_EQ(frames[2].index, 2);
  EXPECT_TRUE(frames[2].fault.empty());
}

TEST_F(FrameSources, GreyFramesAreTheSameInOneChannel) {
  cv::imwrite((folder_ / "img/0.png").string(), cv::Mat(48, 64, CV_8UC3, cv::Scalar(0, 0, 255)));
  std::ofstream(folder_ / "img" / "1.png") << "no picture";
  cv::imwrite((folder_ / "img/2.png").string(), cv::Mat(48, 64, CV_8UC1, cv::Scalar(90)));
  const auto source = greyFrames(openFrames(folder_.string()));
  EXPECT_EQ(source->count(), 3);
  SourceFrame frame;
  ASSERT_TRUE(source->next(frame));
  EXPECT_EQ(frame.image.type(), CV_8UC1);
  EXPECT_NEAR(levelOf(frame), 0.299 * 255, 1);
  ASSERT_TRUE(source->next(frame));
  EXPECT_TRUE(frame.image.empty());
  EXPECT_FALSE(frame.fault.empty());
  ASSERT_TRUE(source->next(frame));
  EXPECT_EQ(frame.index, 2);
  EXPECT_EQ(frame.image.type(), CV_8UC1);
  EXPECT_NEAR(levelOf(frame), 90, 1);
  EXPECT_FALSE(source->next(frame));
}

TEST_F(FrameSources, AVideoHasItsOwnRate) {
  fs::remove_all(folder_ / "img");
  const std::string video = writeVideo("clip.avi");
  for (const std::string& path : {folder_.string(), video}) {
    const std::vector<SourceFrame> frames = all(path);
    ASSERT_EQ(frames.size(), 3U) << path;
    EXPECT_NEAR(levelOf(frames[1]), 100, 3);
    EXPECT_NEAR(frames[2].time_sec, 0.2, 1e-6);
  }
}

TEST_F(FrameSources, FramesBehindUndecodableOnesKeepTheirNumbers) {
  const std::vector<SourceFrame> frames = all(writeDamagedVideo("clip.mp4", "mp4v"));
  const auto damaged = std::find_if(frames.begin(), frames.end(),
                                    [](const SourceFrame& frame) { return !frame.fault.empty(); });
  if (damaged == frames.end()) GTEST_SKIP() << "this decoder leaves out damage without a word";
  EXPECT_TRUE(damaged->image.empty());
  EXPECT_EQ(damaged->fault, "frame " + std::to_string(damaged->index) + " of " +
                                (folder_ / "clip.mp4").string() + " cannot be decoded");
  ASSERT_EQ(frames.size(), 20U);
  EXPECT_EQ(frames.back().index, 19);
  EXPECT_NEAR(frames.back().time_sec, 1.9, 1e-6);
  EXPECT_NEAR(levelOf(frames.back()), 187, 4);
}

TEST_F(FrameSources, AVideoWithFewerFramesThanPromisedIsTold) {
  const std::string path = writeDamagedVideo("clip.avi", "MJPG");
  const auto source = greyFrames(openFrames(path));
  SourceFrame frame;
  int count = 0;
  while (source->next(frame)) ++count;
  ASSERT_LT(count, 20);
  EXPECT_EQ(source->shortfall().rfind(
                path + " promises 20 frames, only " + std::to_string(count) + " came: ", 0),
            0U)
      << source->shortfall();
}

TEST_F(FrameSources, AWholeVideoHasNoShortfall) {
  const auto source = openFrames(writeVideo("clip.avi"));
  SourceFrame frame;
  while (source->next(frame)) EXPECT_EQ(frame.fault, "");
  EXPECT_EQ(source->shortfall(), "");
}

TEST_F(FrameSources, PicturesComeBeforeAVideo) {
  writeVideo("clip.avi");
  writePicture("0.png", 10);
  EXPECT_EQ(all(folder_.string()).size(), 1U);
}

TEST_F(FrameSources, WithoutFramesThePathIsNamed) {
  EXPECT_EQ(omissionsOf(refusalOf([&] { openFrames("/no/such/folder"); }),
                        {"/no/such/folder does not exist"}),
            "");
  EXPECT_EQ(omissionsOf(refusalOf([&] { openFrames(folder_.string()); }),
                        {folder_.string() + " has no pictures in img/ and 0 video files"}),
            "");
  writeVideo("a.avi");
  writeVideo("b.avi");
  EXPECT_EQ(omissionsOf(refusalOf([&] { openFrames(folder_.string()); }),
                        {"2 video files (*.mp4, *.avi), must have one"}),
            "");
  std::ofstream(folder_ / "c.txt") << "no video";
  EXPECT_EQ(omissionsOf(refusalOf([&] { openFrames((folder_ / "c.txt").string()); }),
                        {"c.txt cannot be opened as a video"}),
            "");
}

}  // namespace
}  // namespace chain_tracker
