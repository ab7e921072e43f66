// SPDX-License-Identifier: BSD-3-Clause
/// How things in scenes move: smoothly at random, in bursts, out of the view and back.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/evaluation/scene_options.h"
#include "chain_tracker/image/pixel_geometry.h"

namespace chain_tracker {

/// Frames that are one unit of time: a longer clip moves on, not slower.
constexpr double kFramesPerTime = 300.0;

/// A sum of three sines of random phase: smooth, bounded by 1, never twice the same.
class SmoothMotion {
 public:
  /// `cycles`: slowest sine's number of periods over one unit of time.
  SmoothMotion(double cycles, cv::RNG& rng);
  double at(double time) const;
  /// The bound of the change over one frame.
  double fastestStep() const;

 private:
  double cycles_;
  double phases_[3];
};

/// The stretches of constant rate that were asked for, and the time that stands still meanwhile.
class BurstPath {
 public:
  struct Step {
    double clock = 0.0;  ///< of everything else that moves [frames]
    double angle = 0.0;  ///< turned so far [rad]
    cv::Point2d shift;   ///< [px]; fades when no burst goes on, so that the object stays in view
  };

  /// Shifts keep what is at the image's centre within its middle half.
  BurstPath(const SceneOptions& options, cv::RNG& rng);
  /// `frame` may lie between two frames.
  Step at(double frame) const;

 private:
  std::vector<Step> steps_;  ///< per frame, until nothing changes but the clock
};

/// Where a scene's object is at home.
struct MotionRange {
  cv::Point2d center{0.5, 0.5};   ///< in fractions of the image
  cv::Point2d reach{0.22, 0.22};  ///< to either side of the centre
  double angle = 0.0;             ///< about which it turns [rad]
  double turn = 1.0;              ///< share of the turning asked for
};

/// The object as a whole at one moment, and the times that its own shape follows. These stand still
/// in bursts.
struct ObjectState {
  Similarity image_from_object;
  double bending_time = 0.0;  ///< runs with the speed asked for
  double turning_time = 0.0;  ///< of joints
};

class PoseMotion {
 public:
  /// `radius`: from the object's origin to its farthest point at scale 1 [px].
  PoseMotion(const SceneOptions& options, const MotionRange& range, double radius, cv::RNG& rng);

  /// `frame` may lie between two frames.
  ObjectState at(double frame) const;

 private:
  /// Without leaving the view.
  ObjectState atHome(double frame) const;
  cv::Point2d awayAt(double frame) const;
  /// Shift that just takes it out of view in all the frames that it is to be away [px].
  double exitDistance(double radius) const;

  SceneOptions options_;
  MotionRange range_;
  SmoothMotion x_;
  SmoothMotion y_;
  SmoothMotion turn_;
  SmoothMotion growth_;
  cv::Point2d exit_;  ///< shift that takes the object out of view [px]
  BurstPath bursts_;
};

}  // namespace chain_tracker
