// SPDX-License-Identifier: BSD-3-Clause
/// What can be asked of a rendered scene. Rates are per frame, as a camera sees them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace chain_tracker {

/// A stretch of frames in which the object does nothing but shift or turn, at a constant rate: the
/// pose changes between frames start and start + length, in that many equal steps.
struct SceneBurst {
  int start = 0;      ///< >= 0
  int length = 1;     ///< >= 1
  double rate = 0.0;  ///< of the change from frame to frame [px] or [rad]
};

struct SceneOptions {
  int frames = 300;         ///< length of the motion, >= 1
  std::uint32_t seed = 1;   ///< of texture, background and motion
  cv::Size size{640, 480};  ///< of the image [px], 64 x 64 to 8192 x 8192

  double speed = 1.0;         ///< of shifting and bending; 1 crosses the view in some seconds; 0-20
  double rotation = 0.047;    ///< fastest turn of the object or of a joint [rad/frame], 0 to pi
  double scale_range = 1.35;  ///< size stays within 1/this and this of the mean size, 1 to 3
  std::vector<SceneBurst> shift_bursts;     ///< rate: 0 to a quarter of the shorter side [px/frame]
  std::vector<SceneBurst> rotation_bursts;  ///< rate: -pi to pi [rad/frame]
  int leave_at = 0;                         ///< frame by which it is out of view, 40 to 1000000
  int leave_for = 0;  ///< frames that it stays so at least; 0: it never leaves

  std::optional<double> blur;  ///< open share of the shutter's period, 0-1; unset: the scene's own
  double noise = 2.0;          ///< standard deviation of the sensor noise [grey levels], 0-100
  double illumination = 0.0;   ///< relative drift of the light's strength and colour, 0 to 0.9
  bool grey = false;           ///< a mono camera: all three channels are equal

  std::optional<int> clutter;     ///< things in the object's colours, 0-50; unset: the scene's own
  std::optional<double> shadow;   ///< darkness of the object's shadow, 0-1; unset: the scene's own
  double background_speed = 0.0;  ///< fastest shift of the background [px/frame], 0 to 100
  bool plain = false;  ///< no bands, print or label (bottle, box and strands; others have none)

  int occlusions = 0;          ///< how often something passes over the object, 0-50
  int occlusion_frames = 15;   ///< frames that each covers the object's middle, >= 1
  double occluder_size = 0.6;  ///< width of what passes, of the object's length, 0.2 to 3
};

/// Everything wrong with the options, each naming the option, its value and what is allowed; empty
/// if they can be rendered.
std::vector<std::string> sceneOptionFaults(const SceneOptions& options);

}  // namespace chain_tracker
