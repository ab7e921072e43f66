// SPDX-License-Identifier: BSD-3-Clause
#include "support/drawn_arm.h"

#include <cmath>

namespace chain_tracker {
namespace {

constexpr double kSquare = 8.0;  // [px]

cv::Mat3b randomSquares(cv::RNG& random) {
  cv::Mat3b squares(int(DrawnArm::kWidth / kSquare), int(DrawnArm::kLength / kSquare));
  for (cv::Vec3b& color : squares) {
    for (int channel = 0; channel < 3; ++channel) {
      color[channel] =
          uchar(random.uniform(0, 2) == 0 ? random.uniform(0, 60) : random.uniform(170, 256));
    }
    color[random.uniform(0, 3)] ^= 0xFF;
  }
  return squares;
}

}  // namespace

DrawnArm::DrawnArm(int links) : background_(260, 360) {
  cv::RNG random(11);
  for (cv::Vec3b& color : background_) color = cv::Vec3b::all(uchar(random.uniform(95, 150)));
  for (int i = 0; i < links; ++i) links_.push_back(randomSquares(random));
}

cv::Mat DrawnArm::image(const cv::Point2d& start, const std::vector<double>& angles) const {
  cv::Mat3b image = background_.clone();
  const std::vector<cv::Point2d> joints = vertices(start, angles);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      for (std::size_t i = 0; i < links_.size(); ++i) {
        const cv::Point2d axis(std::cos(angles[i]), std::sin(angles[i]));
        const cv::Point2d from_joint = cv::Point2d(x, y) - joints[i];
        const int column = static_cast<int>(std::floor(axis.dot(from_joint) / kSquare));
        const int row =
            static_cast<int>(std::floor((axis.cross(from_joint) + kWidth / 2) / kSquare));
        if (column < 0 || column >= links_[i].cols || row < 0 || row >= links_[i].rows) continue;
        image(y, x) = links_[i](row, column);
      }
    }
  }
  return image;
}

std::vector<cv::Point2d> DrawnArm::vertices(const cv::Point2d& start,
                                            const std::vector<double>& angles) {
  std::vector<cv::Point2d> vertices = {start};
  for (double angle : angles) {
    vertices.push_back(vertices.back() + kLength * cv::Point2d(std::cos(angle), std::sin(angle)));
  }
  return vertices;
}

}  // namespace chain_tracker
