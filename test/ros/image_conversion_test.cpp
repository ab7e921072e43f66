// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/ros/image_conversion.h"

#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "ros/rendered_scene.h"

namespace chain_tracker {
namespace {

const cv::Mat& scene() {
  static const cv::Mat kScene = RenderedScene(cv::Size(160, 120)).with({{{80.0, 60.0}, 0.3}});
  return kScene;
}

double meanDifference(const cv::Mat& a, const cv::Mat& b) {
  return cv::norm(a, b, cv::NORM_L1) / static_cast<double>(a.total() * 3);
}

cv::Mat greyScene() {
  cv::Mat grey;
  cv::cvtColor(scene(), grey, cv::COLOR_BGR2GRAY);
  cv::cvtColor(grey, grey, cv::COLOR_GRAY2BGR);
  return grey;
}

TEST(ImageConversion, SharesTheMemoryOfBgr8) {
  const sensor_msgs::ImageConstPtr message = imageMsg(scene(), ros::Time(1.0));
  const cv_bridge::CvImageConstPtr image = toBgr8(message);
  EXPECT_EQ(image->image.data, message->data.data());
  EXPECT_EQ(meanDifference(image->image, scene()), 0.0);
}

class ColorEncoding : public testing::TestWithParam<std::string> {};

TEST_P(ColorEncoding, KeepsTheColors) {
  const cv_bridge::CvImageConstPtr image = toBgr8(imageMsg(scene(), ros::Time(1.0), GetParam()));
  ASSERT_EQ(image->image.type(), CV_8UC3);
  ASSERT_EQ(image->image.size(), scene().size());
  EXPECT_LT(meanDifference(image->image, scene()), 0.01);
}

INSTANTIATE_TEST_SUITE_P(All, ColorEncoding,
                         testing::Values("bgr8", "rgb8", "bgra8", "rgba8", "bgr16", "rgb16",
                                         "bgra16", "rgba16"));

class GreyEncoding : public testing::TestWithParam<std::string> {};

TEST_P(GreyEncoding, BecomesGreyBgr) {
  const cv_bridge::CvImageConstPtr image = toBgr8(imageMsg(scene(), ros::Time(1.0), GetParam()));
  ASSERT_EQ(image->image.type(), CV_8UC3);
  EXPECT_LT(meanDifference(image->image, greyScene()), 1.0);
}

INSTANTIATE_TEST_SUITE_P(All, GreyEncoding, testing::Values("mono8", "mono16"));

struct Renamed {
  std::string made_as;
  std::string sent_as;
};

class PlainEncoding : public testing::TestWithParam<Renamed> {};

TEST_P(PlainEncoding, IsReadAsOpenCvOrdersIt) {
  const sensor_msgs::ImagePtr message = imageMsg(scene(), ros::Time(1.0), GetParam().made_as);
  const cv::Mat expected = toBgr8(message)->image.clone();
  message->encoding = GetParam().sent_as;
  EXPECT_EQ(meanDifference(toBgr8(message)->image, expected), 0.0);
}

INSTANTIATE_TEST_SUITE_P(All, PlainEncoding,
                         testing::Values(Renamed{"bgr8", "8UC3"}, Renamed{"bgra8", "8UC4"},
                                         Renamed{"mono8", "8UC1"}, Renamed{"mono16", "16UC1"},
                                         Renamed{"bgr16", "16UC3"}, Renamed{"bgra16", "16UC4"}));

class ByteOrder : public testing::TestWithParam<Renamed> {};

TEST_P(ByteOrder, MakesNoDifference) {
  const sensor_msgs::ImagePtr message = imageMsg(scene(), ros::Time(1.0), GetParam().made_as);
  const cv::Mat expected = toBgr8(message)->image.clone();
  message->encoding = GetParam().sent_as;
  message->is_bigendian = 1;
  for (std::size_t i = 1; i < message->data.size(); i += 2) {
    std::swap(message->data[i - 1], message->data[i]);
  }
  EXPECT_EQ(meanDifference(toBgr8(message)->image, expected), 0.0);
}

INSTANTIATE_TEST_SUITE_P(All, ByteOrder,
                         testing::Values(Renamed{"mono16", "mono16"}, Renamed{"mono16", "16UC1"},
                                         Renamed{"bgr16", "bgr16"}, Renamed{"rgba16", "rgba16"}));

TEST(ImageConversion, DemosaicsEveryBayerPattern) {
  // An image of one colour has the same mosaic values wherever the pattern begins.
  const cv::Vec3b color(40, 120, 220);
  const cv::Mat plain(32, 32, CV_8UC3, cv::Scalar(color[0], color[1], color[2]));
  const std::string patterns[] = {"rggb", "bggr", "gbrg", "grbg"};
  for (const std::string& pattern : patterns) {
    for (const int bits : {8, 16}) {
      SCOPED_TRACE(pattern + std::to_string(bits));
      cv::Mat mosaic(plain.size(), CV_8UC1);
      for (int y = 0; y < mosaic.rows; ++y) {
        for (int x = 0; x < mosaic.cols; ++x) {
          const char letter = pattern[static_cast<std::size_t>(2 * (y % 2) + x % 2)];
          mosaic.at<uchar>(y, x) = color[letter == 'r' ? 2 : letter == 'g' ? 1 : 0];
        }
      }
      if (bits == 16) mosaic.convertTo(mosaic, CV_16UC1, 257.0);
      const cv_bridge::CvImage image(std_msgs::Header(), "bayer_" + pattern + std::to_string(bits),
                                     mosaic);
      const cv::Mat result = toBgr8(image.toImageMsg())->image;
      const cv::Rect inner(2, 2, 28, 28);
      EXPECT_LT(cv::norm(result(inner), plain(inner), cv::NORM_INF), 2.0);
    }
  }
}

TEST(ImageConversion, ReadsYuv422) {
  sensor_msgs::Image message;
  message.encoding = "yuv422";
  message.width = 4;
  message.height = 2;
  message.step = 8;
  for (int pair = 0; pair < 4; ++pair) {
    message.data.insert(message.data.end(), {128, 200, 128, 200});  // U Y V Y without colour
  }
  const cv::Mat image = toBgr8(boost::make_shared<sensor_msgs::Image>(message))->image;
  ASSERT_EQ(image.size(), cv::Size(4, 2));
  double least = 0.0;
  double most = 0.0;
  cv::minMaxLoc(image.reshape(1), &least, &most);
  EXPECT_EQ(least, most);
  EXPECT_NEAR(least, 214.0, 2.0);  // (200 - 16) * 255 / 219
}

/// What is thrown for a message, or nothing.
std::string refusalOf(const sensor_msgs::Image& message) {
  try {
    toBgr8(boost::make_shared<sensor_msgs::Image>(message));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(ImageConversion, RefusesWhatItCannotRead) {
  const sensor_msgs::Image good = *imageMsg(scene(), ros::Time(1.0));
  ASSERT_EQ(refusalOf(good), "");

  sensor_msgs::Image unknown = good;
  unknown.encoding = "infrared7";
  EXPECT_NE(refusalOf(unknown).find("'infrared7', 160 x 120 px"), std::string::npos);

  sensor_msgs::Image depth = good;
  depth.encoding = "32FC1";
  depth.step = depth.width * 4;
  depth.data.resize(std::size_t{4} * depth.width * depth.height);
  EXPECT_NE(refusalOf(depth).find("32FC1"), std::string::npos);

  sensor_msgs::Image empty = good;
  empty.width = 0;
  EXPECT_NE(refusalOf(empty).find("is empty"), std::string::npos);
  EXPECT_NE(refusalOf(sensor_msgs::Image()).find("is empty"), std::string::npos);

  sensor_msgs::Image cut = good;
  cut.data.resize(cut.data.size() / 2);
  EXPECT_NE(refusalOf(cut), "");

  sensor_msgs::Image narrow = good;
  narrow.step = 3;
  EXPECT_NE(refusalOf(narrow), "");
}

}  // namespace
}  // namespace chain_tracker
