// SPDX-License-Identifier: BSD-3-Clause
#include "tools/common/bag_frames.h"

#include <filesystem>
#include <string>
#include <vector>

#include <cv_bridge/cv_bridge.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <rosbag/bag.h>
#include <sensor_msgs/CompressedImage.h>
#include <std_msgs/String.h>

#include "chain_tracker/ros/image_conversion.h"
#include "support/refusal.h"

namespace chain_tracker {
namespace {

class BagFrames : public testing::Test {
 protected:
  BagFrames()
      : path_((std::filesystem::path(testing::TempDir()) /
               (std::string("frames_") +
                testing::UnitTest::GetInstance()->current_test_info()->name() + ".bag"))
                  .string()) {
    bag_.open(path_, rosbag::bagmode::Write);
  }
  ~BagFrames() override { std::filesystem::remove(path_); }

  static std_msgs::Header header(double stamp, const std::string& frame_id = "camera") {
    std_msgs::Header header;
    header.stamp = ros::Time(stamp);
    header.frame_id = frame_id;
    return header;
  }

  static cv::Mat picture(int level) { return cv::Mat(6, 8, CV_8UC3, cv::Scalar(level, 20, 30)); }

  /// Recorded at `time`, whatever its stamp says.
  void add(double time, double stamp, const std::string& encoding = "bgr8",
           const std::string& frame_id = "camera") {
    const auto bgr = boost::make_shared<cv_bridge::CvImage>(header(stamp, frame_id), "bgr8",
                                                            picture(static_cast<int>(time)));
    bag_.write("/image", ros::Time(time), cv_bridge::cvtColor(bgr, encoding)->toImageMsg());
  }

  std::vector<SourceFrame> read(const std::string& topic = "/image") {
    bag_.close();
    const auto source = openBagFrames(path_, topic);
    std::vector<SourceFrame> frames;
    SourceFrame frame;
    while (source->next(frame)) frames.push_back(frame);
    EXPECT_EQ(source->count(), static_cast<int>(frames.size()));
    return frames;
  }

  std::string path_;
  rosbag::Bag bag_;
};

TEST_F(BagFrames, ComeInOrderWithTheirStamps) {
  for (const double time : {10.0, 11.0, 12.0}) add(time, time - 5.0);
  const std::vector<SourceFrame> frames = read();
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[1].index, 1);
  EXPECT_DOUBLE_EQ(frames[1].time_sec, 6.0);
  EXPECT_EQ(cv::norm(frames[1].image, picture(11), cv::NORM_INF), 0.0);
}

TEST_F(BagFrames, AreConvertedAsTheNodeletConvertsThem) {
  const std::vector<std::string> encodings = {"mono8", "mono16", "rgb8", "bgra8", "bgr16"};
  double time = 10.0;
  for (const std::string& encoding : encodings) {
    add(time, time, encoding);
    time += 1.0;
  }
  const std::vector<SourceFrame> frames = read();
  ASSERT_EQ(frames.size(), encodings.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto bgr = boost::make_shared<cv_bridge::CvImage>(header(1.0), "bgr8",
                                                            picture(10 + static_cast<int>(i)));
    const auto expected = toBgr8(cv_bridge::cvtColor(bgr, encodings[i])->toImageMsg());
    EXPECT_EQ(frames[i].image.type(), CV_8UC3);
    EXPECT_EQ(cv::norm(frames[i].image, expected->image, cv::NORM_INF), 0.0) << encodings[i];
  }
}

TEST_F(BagFrames, MayBeCompressed) {
  sensor_msgs::CompressedImage message;
  message.header = header(3.0);
  message.format = "bgr8; png compressed bgr8";
  cv::imencode(".png", picture(77), message.data);
  bag_.write("/image/compressed", ros::Time(3.0), message);
  const std::vector<SourceFrame> frames = read("/image/compressed");
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(cv::norm(frames[0].image, picture(77), cv::NORM_INF), 0.0);
}

TEST_F(BagFrames, AMessageThatCannotBeDecodedIsAFrameWithAFault) {
  add(10.0, 10.0);
  sensor_msgs::Image broken = *cv_bridge::CvImage(header(11.0), "bgr8", picture(1)).toImageMsg();
  broken.encoding = "infrared7";
  bag_.write("/image", ros::Time(11.0), broken);
  add(12.0, 12.0);
  const std::vector<SourceFrame> frames = read();
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_TRUE(frames[1].image.empty());
  EXPECT_EQ(frames[1].fault.rfind("frame 1, a message of /image: ", 0), 0U) << frames[1].fault;
  EXPECT_NE(frames[1].fault.find("infrared7"), std::string::npos) << frames[1].fault;
  EXPECT_TRUE(frames[2].fault.empty());
}

TEST_F(BagFrames, ASharedStampDoesNotShiftTheOthers) {
  for (const double stamp : {1.0, 2.0, 2.0, 3.0}) add(10.0 + stamp, stamp);
  bag_.close();
  const auto index_of = indexByStamp(path_, "/image");
  EXPECT_EQ(index_of.size(), 3U);
  EXPECT_EQ(index_of.at(ros::Time(2.0)), 1);
  EXPECT_EQ(index_of.at(ros::Time(3.0)), 3);
}

TEST_F(BagFrames, ARecordingIsMatchedByStampsOfTheirOwn) {
  for (const double stamp : {1.0, 3.0, 2.0}) add(10.0 + stamp, stamp);
  bag_.close();
  EXPECT_EQ(refusalOf([&] { indexByOwnStamps(path_, "/image"); }), "")
      << "their order does not count";
}

TEST_F(BagFrames, TheLongestPauseIsBetweenStampsInTheirOrder) {
  for (const double stamp : {1.0, 9.0, 4.0, 5.0}) add(10.0 + stamp, stamp);
  bag_.close();
  EXPECT_DOUBLE_EQ(longestPause(indexByOwnStamps(path_, "/image")), 4.0);
  EXPECT_DOUBLE_EQ(longestPause({{ros::Time(3.0), 0}}), 0.0);
}

TEST_F(BagFrames, ARecordingCannotBeMatchedWithoutStamps) {
  for (const double time : {10.0, 11.0}) add(time, 0.0);
  bag_.close();
  EXPECT_EQ(omissionsOf(refusalOf([&] { indexByOwnStamps(path_, "/image"); }),
                        {path_ + ": frame 0 of /image has no stamp", "use `evaluate --bag`"}),
            "");
}

TEST_F(BagFrames, ARecordingCannotBeMatchedBySharedStamps) {
  for (const double stamp : {1.0, 2.0, 3.0, 2.0}) add(10.0 + stamp, stamp);
  bag_.close();
  EXPECT_EQ(omissionsOf(refusalOf([&] { indexByOwnStamps(path_, "/image"); }),
                        {path_ + ": frame ", "of /image has the stamp of frame 1"}),
            "");
}

TEST_F(BagFrames, WhatIsOddAboutABagIsTold) {
  for (int i = 0; i < 10; ++i) add(10.0 + i, 10.0 + i);
  add(30.0, 30.0);
  add(31.0, 29.0, "rgb8", "another");
  bag_.close();
  std::string findings;
  for (const std::string& finding : checkBag(path_, "/image")) findings += finding + "\n";
  for (const char* text :
       {"frame 10: a gap of 11 s, usual are 1 s", "frame 11: the stamp goes back",
        "the frame id changes: 'another', 'camera'", "the encoding changes: 'bgr8', 'rgb8'"}) {
    EXPECT_NE(findings.find(text), std::string::npos) << text << "\n" << findings;
  }
}

TEST_F(BagFrames, AGoodBagHasNoFindings) {
  for (int i = 0; i < 10; ++i) add(10.0 + i, 10.0 + i);
  bag_.close();
  EXPECT_TRUE(checkBag(path_, "/image").empty());
}

TEST_F(BagFrames, AMissingTopicIsRefusedWithTheImageTopicsThereAre) {
  add(10.0, 10.0);
  bag_.write("/chatter", ros::Time(10.0), std_msgs::String());
  bag_.close();
  const std::string refusal = refusalOf([&] { openBagFrames(path_, "/nope"); });
  EXPECT_EQ(omissionsOf(refusal, {path_, "'/nope'", "topics of that type: /image"}), "");
  EXPECT_EQ(refusal.find("/chatter"), std::string::npos) << "has no images";
}

TEST_F(BagFrames, ATruncatedBagIsRefusedWithWhatToDo) {
  for (int i = 0; i < 10; ++i) add(10.0 + i, 10.0 + i);
  bag_.close();
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) / 2);
  EXPECT_EQ(omissionsOf(refusalOf([&] { openBagFrames(path_, "/image"); }),
                        {path_, "cannot be read as a bag", "rosbag reindex"}),
            "");
  EXPECT_EQ(omissionsOf(refusalOf([] { openBagFrames("/no/such.bag", "/image"); }),
                        {"/no/such.bag does not exist"}),
            "");
}

}  // namespace
}  // namespace chain_tracker
