// SPDX-License-Identifier: BSD-3-Clause
/// A box of coloured squares before a greyish background, drawn anywhere: what a tracker must
/// follow with ease.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/image/pixel_geometry.h"

namespace chain_tracker {

class DrawnBox {
 public:
  static constexpr int kImageWidth = 320;
  static constexpr int kImageHeight = 240;
  static constexpr double kLength = 96.0;  ///< along the box's x [px]
  static constexpr double kWidth = 60.0;   ///< along its y [px]

  /// `type`: CV_8UC3 or CV_8UC1, of all images.
  explicit DrawnBox(int type = CV_8UC3);

  /// The image with the box, whose frame's origin is its centre.
  cv::Mat image(const Similarity& image_from_box) const;

  /// The image without it.
  cv::Mat background() const { return converted(background_); }

  /// Where its corners are, in order, beginning at its top left.
  static std::vector<cv::Point2d> corners(const Similarity& image_from_box);

 private:
  cv::Mat converted(const cv::Mat3b& image) const;

  int type_;
  cv::Mat3b squares_;
  cv::Mat3b background_;
};

}  // namespace chain_tracker
