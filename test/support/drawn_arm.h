// SPDX-License-Identifier: BSD-3-Clause
/// Links of coloured squares joined end to end before a greyish background.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace chain_tracker {

class DrawnArm {
 public:
  static constexpr double kLength = 72.0;  ///< of a link [px]
  static constexpr double kWidth = 24.0;   ///< of a link [px]

  explicit DrawnArm(int links);

  /// The free end at `start`, the links at these angles to the image's x [rad].
  cv::Mat image(const cv::Point2d& start, const std::vector<double>& angles) const;

  /// The free end, the joints, the other free end.
  static std::vector<cv::Point2d> vertices(const cv::Point2d& start,
                                           const std::vector<double>& angles);

 private:
  cv::Mat3b background_;
  std::vector<cv::Mat3b> links_;
};

}  // namespace chain_tracker
