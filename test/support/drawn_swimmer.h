// SPDX-License-Identifier: BSD-3-Clause
/// A dark body that swims on the spot before a grey ground: flat inside, so that it looks the same
/// wherever in it one looks.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_model.h"

namespace chain_tracker {

/// Grey clutter of 400 x 240 px.
cv::Mat3b clutteredGround(cv::RNG& random);

class DrawnSwimmer {
 public:
  static constexpr double kLength = 260.0;  ///< [px]

  /// Thick in its first half and thin at its tail, which beats.
  static DrawnSwimmer fish() { return {26.0, 0.6, 0.5, 1.0}; }
  /// Of the same thickness nearly to its ends, bending as much all along.
  static DrawnSwimmer worm() { return {26.0, 0.0, 0.35, 0.0}; }

  /// Its middle in frame `frame`, from head to tail.
  std::vector<cv::Point2d> midline(int frame) const;

  /// Each call has noise of its own.
  cv::Mat3b image(int frame);

 private:
  DrawnSwimmer(double thickness, double taper, double bend, double tail)
      : thickness_(thickness), taper_(taper), bend_(bend), tail_(tail) {}

  double thicknessAt(double along) const;

  double thickness_;  // of the thickest place beyond the least [px]
  double taper_;      // 0: not at all
  double bend_;       // [rad]
  double tail_;       // how much less the head bends: 0 as much, 1 not at all
  cv::RNG random_{11};
};

/// Mean distance [px] from its true midline of what a tracker of the model makes of it, in 120
/// frames, started with the first one's.
double errorOfMidline(const ChainModel& model, DrawnSwimmer swimmer);

}  // namespace chain_tracker
