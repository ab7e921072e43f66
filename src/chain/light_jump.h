// SPDX-License-Identifier: BSD-3-Clause
/// Light that changes all over the image from one frame to the next: a lamp is switched, the camera
/// sets its exposure anew. What moves changes pixels, too, but not all alike.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace chain_tracker {

class LightJump {
 public:
  /// `image`: the first one, CV_8UC3 or CV_8UC1, as all others.
  explicit LightJump(const cv::Mat& image);

  /// By which factors the channels have changed since the image before; the one of a grey image is
  /// given thrice. 1 each if less than a jump, or if the pixels do not agree on it. O(1).
  cv::Vec3d observe(const cv::Mat& image);

 private:
  bool hasChanged() const;
  double logRatioOf(int channel);

  cv::Mat before_;
  cv::Mat now_;
  std::vector<double> logs_;  // of a channel's ratios, then how far they are from their median
};

}  // namespace chain_tracker
