// SPDX-License-Identifier: BSD-3-Clause
/// How the light on an object has changed since the first frame: its brightness, its colour, the
/// camera's exposure and white balance. All of them multiply the channels (von Kries 1902), the
/// same for all parts, so that three numbers undo them: too few to learn the background by.
#pragma once

#include <array>
#include <vector>

#include "chain_tracker/image/color_palette.h"
#include "chain_tracker/image/frame_pixels.h"

namespace chain_tracker {

class LightChange {
 public:
  /// `rate`: share of a change that is followed at once, in [0, 1].
  explicit LightChange(double rate) : rate_(rate) {}

  /// Takes in what the object's parts showed in the first frame and show now, entry by entry. The
  /// median part decides; parts that show little of the object have no say, and fewer than three
  /// tell nothing. O(parts).
  void observe(const std::vector<ObjectColor>& learned, const std::vector<ObjectColor>& seen);

  /// Takes in that all light has changed at once by `ratios` of the channels.
  void jump(const cv::Vec3d& ratios);

  /// By which the channels are to be multiplied, each in [1/2, 2].
  ChannelGains gains() const;

 private:
  double rate_;
  std::array<double, 3> gains_ = {1.0, 1.0, 1.0};
  std::vector<double> ratios_;  // of one channel of the parts
};

}  // namespace chain_tracker
