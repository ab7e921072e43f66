// SPDX-License-Identifier: BSD-3-Clause
/// What the running tracker makes of the images cameras and bags send.
#include <string>

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Log.h>

#include "ros/tracker_client.h"

namespace chain_tracker {
namespace {

class ImageStreamTest : public testing::Test {
 protected:
  ImageStreamTest() : client_("tracker") {}
  void SetUp() override { ASSERT_TRUE(client_.ready()); }
  void TearDown() override { client_.remove("bottle"); }

  void startBottle(const BottlePose& pose = BottlePose()) {
    const auto answer = client_.setTarget(bottleRequest("bottle", pose), scene_.with({pose}));
    ASSERT_TRUE(answer.success) << answer.message;
  }

  std::optional<TrackedObject> show(const sensor_msgs::ImagePtr& image) {
    return objectOf(client_.show(*image), "bottle");
  }

  RenderedScene scene_;
  TrackerClient client_;
};

class EncodingTest : public ImageStreamTest, public testing::WithParamInterface<std::string> {};

TEST_P(EncodingTest, IsTracked) {
  const auto imageAt = [this](const BottlePose& pose) {
    return imageMsg(scene_.with({pose}), nextStamp(), GetParam());
  };
  BottlePose pose;
  // Objects start on the next image: one of this encoding, sent once the request has arrived.
  auto request = bottleRequest("bottle", pose);
  const auto first = imageAt(pose);
  ASSERT_TRUE(client_.show(*first));
  request.stamp = first->header.stamp;
  const auto answer = client_.setTarget(request, cv::Mat());
  ASSERT_TRUE(answer.success) << answer.message;
  for (int k = 0; k < 5; ++k) {
    pose.centre.x += 4.0;
    EXPECT_TRUE(isAt(show(imageAt(pose)), pose)) << "image " << k;
  }
}

INSTANTIATE_TEST_SUITE_P(All, EncodingTest,
                         testing::Values("mono8", "mono16", "rgb8", "bgra8", "bgr16",
                                         "bayer_rggb8"));

/// Counts the errors of the tracker that contain a text.
class ErrorCounter {
 public:
  explicit ErrorCounter(const std::string& text)
      : subscriber_(ros::NodeHandle().subscribe<rosgraph_msgs::Log>(
            "/rosout", 100, [this, text](const rosgraph_msgs::LogConstPtr& log) {
              const bool found = log->msg.find(text) != std::string::npos;
              if (log->level == rosgraph_msgs::Log::ERROR && found) ++count_;
            })) {
    EXPECT_TRUE(waitUntil([this] { return subscriber_.getNumPublishers() > 0; }));
  }
  int count() const { return count_; }

 private:
  int count_ = 0;
  ros::Subscriber subscriber_;
};

TEST_F(ImageStreamTest, UnknownEncodingsAndBrokenImagesAreNamedAndSurvived) {
  startBottle();
  const ErrorCounter errors("'infrared7'");
  const std::size_t before = client_.received().size();
  const sensor_msgs::Image good = *imageMsg(scene_.with({BottlePose()}), nextStamp());
  sensor_msgs::Image unknown = good;
  unknown.encoding = "infrared7";
  sensor_msgs::Image cut = good;
  cut.data.resize(100);
  // rosout may learn of its listeners late, and the error is throttled: try until it is heard.
  EXPECT_TRUE(waitUntil([&] {
    for (const sensor_msgs::Image& image : {unknown, cut, sensor_msgs::Image()}) {
      client_.publish(image);
      waitUntil([] { return false; }, 0.05);
    }
    return errors.count() > 0;
  }));
  EXPECT_EQ(client_.received().size(), before);
  EXPECT_TRUE(isAt(show(imageMsg(scene_.with({BottlePose()}), nextStamp())), BottlePose()));
}

TEST_F(ImageStreamTest, OnlyTheSecondEmptyImageInARowIsAnError) {
  startBottle();
  const ErrorCounter single("'single'");
  const ErrorCounter pair("'pair'");
  sensor_msgs::Image empty;
  const auto shown_after = [&](const std::string& encoding, int times) {
    empty.encoding = encoding;
    for (int k = 0; k < times; ++k) client_.publish(empty);
    waitUntil([] { return false; }, 0.05);  // or the next image would replace it
    return isAt(show(imageMsg(scene_.with({BottlePose()}), nextStamp())), BottlePose());
  };
  EXPECT_TRUE(waitUntil([&] {
    EXPECT_TRUE(shown_after("single", 1));
    EXPECT_TRUE(shown_after("pair", 2));
    return pair.count() > 0;
  }));
  EXPECT_EQ(single.count(), 0);
}

TEST_F(ImageStreamTest, AnErrorIsNotRepeatedForEveryImage) {
  const ErrorCounter errors("'ultraviolet'");
  sensor_msgs::Image unknown = *imageMsg(scene_.wall(), nextStamp());
  unknown.encoding = "ultraviolet";
  for (int k = 0; k < 50; ++k) {
    client_.publish(unknown);
    waitUntil([] { return false; }, 0.01);
  }
  client_.show(scene_.wall());
  EXPECT_LE(errors.count(), 1);
}

TEST_F(ImageStreamTest, ABagThatStartsAgainStartsTheObjectAgain) {
  const ros::Time begin = nextStamp();
  std::vector<sensor_msgs::ImagePtr> bag;
  for (int k = 0; k < 8; ++k) {
    BottlePose pose;
    pose.centre.x += 6.0 * k;
    bag.push_back(imageMsg(scene_.with({pose}), begin + ros::Duration(0.1 * k)));
  }
  auto request = bottleRequest("bottle", BottlePose());
  ASSERT_TRUE(client_.show(*bag[0]));
  request.stamp = begin;
  ASSERT_TRUE(client_.setTarget(request, cv::Mat()).success);
  const std::size_t before = client_.received().size();
  for (int loop = 0; loop < 3; ++loop) {
    for (std::size_t k = loop == 0 ? 1 : 0; k < bag.size(); ++k) {
      BottlePose pose;
      pose.centre.x += 6.0 * static_cast<double>(k);
      const auto object = show(bag[k]);
      EXPECT_TRUE(isAt(object, pose)) << "loop " << loop << ", image " << k;
      if (object && k == 0) {
        EXPECT_EQ(object->state, TrackedObject::INITIALIZING);
      }
      if (object && k > 0) {
        EXPECT_EQ(object->state, TrackedObject::TRACKING);
      }
    }
  }
  EXPECT_EQ(client_.received().size() - before, 3 * bag.size() - 1);
  for (int k = 0; k < 8; ++k) nextStamp();  // beyond the bag
}

TEST_F(ImageStreamTest, AnotherSizeContinuesWhereTheObjectIs) {
  startBottle();
  cv::Mat half;
  cv::resize(scene_.with({BottlePose()}), half, cv::Size(), 0.5, 0.5, cv::INTER_AREA);
  BottlePose half_pose;
  half_pose.centre *= 0.5;
  for (int k = 0; k < 3; ++k) {
    EXPECT_TRUE(isAt(show(imageMsg(half, nextStamp())), half_pose)) << "image " << k;
  }
  EXPECT_TRUE(isAt(show(imageMsg(scene_.with({BottlePose()}), nextStamp())), BottlePose()));
}

TEST_F(ImageStreamTest, TinyImagesAreSurvived) {
  startBottle();
  const cv::Mat pixel(1, 1, CV_8UC3, cv::Scalar(1, 2, 3));
  ASSERT_TRUE(client_.show(pixel));
  EXPECT_TRUE(client_.show(scene_.wall()));
}

TEST_F(ImageStreamTest, WhenImagesComeTooFastTheLatestWins) {
  startBottle();
  const std::size_t before = client_.received().size();
  ros::Time last;
  for (int k = 0; k < 200; ++k) {
    last = nextStamp();
    client_.publish(*imageMsg(scene_.with({BottlePose()}), last));
  }
  ASSERT_TRUE(waitUntil([&] {
    return client_.received().size() > before && client_.received().back().header.stamp == last;
  }));
  for (std::size_t k = before + 1; k < client_.received().size(); ++k) {
    EXPECT_GT(client_.received()[k].header.stamp, client_.received()[k - 1].header.stamp);
  }
}

}  // namespace
}  // namespace chain_tracker

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "image_stream_rostest");
  const ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
