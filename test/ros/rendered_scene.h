// SPDX-License-Identifier: BSD-3-Clause
/// A rendered bottle before a rendered wall: pictures whose truth is known.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <boost/make_shared.hpp>
#include <cv_bridge/cv_bridge.h>
#include <opencv2/imgproc.hpp>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/image_encodings.h>

namespace chain_tracker {

struct BottlePose {
  cv::Point2d centre{160.0, 120.0};  ///< [px]
  double angle = 1.5707963;          ///< of the axis [rad]; pi / 2 is upright
};

/// A bottle of 110 x 44 px with coloured, speckled bands before a grey, speckled wall. The same
/// arguments give the same picture.
class RenderedScene {
 public:
  explicit RenderedScene(const cv::Size& size = cv::Size(320, 240)) : wall_(size, CV_8UC3) {
    cv::RNG random(7);
    random.fill(wall_, cv::RNG::UNIFORM, 90, 160);
    cv::GaussianBlur(wall_, wall_, cv::Size(7, 7), 0.0);
    wall_ = (wall_ - cv::Scalar::all(125)) * 2.0 + cv::Scalar(130, 120, 115);
    bottle_ = bottlePicture(&random);
  }

  cv::Mat wall() const { return wall_.clone(); }

  cv::Mat with(const std::vector<BottlePose>& bottles) const {
    cv::Mat image = wall();
    for (const BottlePose& pose : bottles) {
      cv::Mat turned;
      cv::Mat mask(bottle_.size(), CV_8UC1, cv::Scalar(255));
      cv::warpAffine(bottle_, turned, imageFromBottle(pose), image.size());
      cv::warpAffine(mask, mask, imageFromBottle(pose), image.size());
      turned.copyTo(image, mask > 127);
    }
    return image;
  }

  /// The two ends of the bottle's axis.
  static std::vector<cv::Point2d> endsOf(const BottlePose& pose) {
    const cv::Point2d half(0.5 * kLength * std::cos(pose.angle),
                           0.5 * kLength * std::sin(pose.angle));
    return {pose.centre - half, pose.centre + half};
  }

 private:
  static constexpr int kLength = 110;
  static constexpr int kWidth = 44;

  static cv::Mat bottlePicture(cv::RNG* random) {
    const std::array<cv::Scalar, 5> bands = {cv::Scalar(40, 40, 200), cv::Scalar(40, 180, 60),
                                             cv::Scalar(200, 60, 40), cv::Scalar(30, 190, 220),
                                             cv::Scalar(160, 40, 150)};
    cv::Mat bottle(kWidth, kLength, CV_8UC3);
    random->fill(bottle, cv::RNG::UNIFORM, 0, 40);
    const int band = kLength / static_cast<int>(bands.size());
    for (int i = 0; i < static_cast<int>(bands.size()); ++i) {
      bottle(cv::Rect(i * band, 0, band, kWidth)) += bands[static_cast<std::size_t>(i)];
    }
    return bottle;
  }

  static cv::Matx23d imageFromBottle(const BottlePose& pose) {
    const double cosine = std::cos(pose.angle);
    const double sine = std::sin(pose.angle);
    const cv::Point2d middle(0.5 * (kLength - 1), 0.5 * (kWidth - 1));
    return {cosine, -sine,  pose.centre.x - cosine * middle.x + sine * middle.y,
            sine,   cosine, pose.centre.y - sine * middle.x - cosine * middle.y};
  }

  cv::Mat wall_;
  cv::Mat bottle_;
};

/// The picture (CV_8UC3 BGR) in a Bayer pattern whose first row begins with red.
inline cv::Mat bayerRggb(const cv::Mat& image) {
  cv::Mat mosaic(image.size(), CV_8UC1);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const int channel = y % 2 == 0 && x % 2 == 0 ? 2 : y % 2 == 1 && x % 2 == 1 ? 0 : 1;
      mosaic.at<uchar>(y, x) = image.at<cv::Vec3b>(y, x)[channel];
    }
  }
  return mosaic;
}

/// The picture (CV_8UC3 BGR) as a message of any colour, grey or 8-bit Bayer encoding.
inline sensor_msgs::ImagePtr imageMsg(const cv::Mat& image, const ros::Time& stamp,
                                      const std::string& encoding = "bgr8",
                                      const std::string& frame_id = "camera") {
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = frame_id;
  if (encoding == sensor_msgs::image_encodings::BAYER_RGGB8) {
    return cv_bridge::CvImage(header, encoding, bayerRggb(image)).toImageMsg();
  }
  const auto bgr =
      boost::make_shared<cv_bridge::CvImage>(header, sensor_msgs::image_encodings::BGR8, image);
  return cv_bridge::cvtColor(bgr, encoding)->toImageMsg();
}

}  // namespace chain_tracker
