// SPDX-License-Identifier: BSD-3-Clause
#include "support/drawn_box.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace chain_tracker {
namespace {

constexpr double kSquare = 12.0;  // [px]

}  // namespace

DrawnBox::DrawnBox(int type) : type_(type) {
  cv::RNG random(7);
  squares_.create(int(kWidth / kSquare), int(kLength / kSquare));
  for (cv::Vec3b& color : squares_) {
    // Far from grey, and of many brightnesses.
    for (int channel = 0; channel < 3; ++channel) {
      color[channel] = random.uniform(0, 2) == 0 ? uchar(random.uniform(0, 60))
                                                 : uchar(random.uniform(170, 256));
    }
    color[random.uniform(0, 3)] ^= 0xFF;
  }
  background_.create(kImageHeight, kImageWidth);
  for (cv::Vec3b& color : background_) {
    const int grey = random.uniform(95, 150);
    for (int channel = 0; channel < 3; ++channel) {
      color[channel] = uchar(grey + random.uniform(-8, 9));
    }
  }
}

cv::Mat DrawnBox::image(const Similarity& image_from_box) const {
  cv::Mat3b image = background_.clone();
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const cv::Point2d on_box = image_from_box.applyInverse(cv::Point2d(x, y));
      const int column = static_cast<int>(std::floor((on_box.x + kLength / 2) / kSquare));
      const int row = static_cast<int>(std::floor((on_box.y + kWidth / 2) / kSquare));
      if (column < 0 || column >= squares_.cols || row < 0 || row >= squares_.rows) continue;
      image(y, x) = squares_(row, column);
    }
  }
  return converted(image);
}

std::vector<cv::Point2d> DrawnBox::corners(const Similarity& image_from_box) {
  std::vector<cv::Point2d> corners;
  for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
    corners.push_back(image_from_box.apply({x * kLength / 2, y * kWidth / 2}));
  }
  return corners;
}

cv::Mat DrawnBox::converted(const cv::Mat3b& image) const {
  if (type_ == CV_8UC3) return image.clone();
  cv::Mat grey;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

}  // namespace chain_tracker
