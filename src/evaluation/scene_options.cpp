// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/evaluation/scene_options.h"

#include <algorithm>
#include <sstream>

namespace chain_tracker {
namespace {

using Faults = std::vector<std::string>;

template <typename Value>
void require(bool good, const std::string& option, const Value& value, const std::string& allowed,
             Faults& faults) {
  if (good) return;
  std::ostringstream message;
  message << "scene option " << option << " is " << value << ", must be " << allowed;
  faults.push_back(message.str());
}

/// Refuses NaN too.
template <typename Value>
void requireWithin(const Value& low, const Value& high, const std::string& option,
                   const Value& value, Faults& faults) {
  std::ostringstream allowed;
  allowed << "in [" << low << ", " << high << "]";
  require(value >= low && value <= high, option, value, allowed.str(), faults);
}

void checkBursts(const std::vector<SceneBurst>& bursts, double low, double high,
                 const std::string& option, Faults& faults) {
  for (const SceneBurst& burst : bursts) {
    requireWithin(0, 1000000, option + ".start", burst.start, faults);
    requireWithin(1, 1000000, option + ".length", burst.length, faults);
    requireWithin(low, high, option + ".rate", burst.rate, faults);
  }
}

void checkMotion(const SceneOptions& options, Faults& faults) {
  requireWithin(0.0, 20.0, "speed", options.speed, faults);
  requireWithin(0.0, CV_PI, "rotation", options.rotation, faults);
  requireWithin(1.0, 3.0, "scale_range", options.scale_range, faults);
  const double farthest = 0.25 * std::min(options.size.width, options.size.height);
  checkBursts(options.shift_bursts, 0.0, farthest, "shift_bursts", faults);
  checkBursts(options.rotation_bursts, -CV_PI, CV_PI, "rotation_bursts", faults);
  requireWithin(0, 1000000, "leave_for", options.leave_for, faults);
  require(options.leave_for <= 0 || (options.leave_at >= 40 && options.leave_at <= 1000000),
          "leave_at", options.leave_at,
          "in [40, 1000000] when the object leaves, which takes it 40 frames", faults);
}

void checkOcclusions(const SceneOptions& options, Faults& faults) {
  requireWithin(0, 50, "occlusions", options.occlusions, faults);
  requireWithin(0.2, 3.0, "occluder_size", options.occluder_size, faults);
  require(options.occlusion_frames >= 1, "occlusion_frames", options.occlusion_frames, "at least 1",
          faults);
  if (options.occlusions < 1 || !faults.empty()) return;
  // Before the first frame's half of it has passed the object is not seen whole.
  const double share = 2.0 * options.occluder_size / (1.0 + options.occluder_size);
  const int longest = static_cast<int>(share * options.frames / (options.occlusions + 1)) - 1;
  std::ostringstream allowed;
  allowed << "at most " << longest << " with " << options.occlusions << " occlusions in "
          << options.frames << " frames";
  require(options.occlusion_frames <= longest, "occlusion_frames", options.occlusion_frames,
          allowed.str(), faults);
}

}  // namespace

std::vector<std::string> sceneOptionFaults(const SceneOptions& options) {
  Faults faults;
  require(options.frames >= 1, "frames", options.frames, "at least 1", faults);
  require(options.size.width >= 64 && options.size.height >= 64 && options.size.width <= 8192 &&
              options.size.height <= 8192,
          "size", options.size, "from 64 x 64 to 8192 x 8192", faults);
  checkMotion(options, faults);
  if (options.blur) requireWithin(0.0, 1.0, "blur", *options.blur, faults);
  requireWithin(0.0, 100.0, "noise", options.noise, faults);
  requireWithin(0.0, 0.9, "illumination", options.illumination, faults);
  if (options.clutter) requireWithin(0, 50, "clutter", *options.clutter, faults);
  if (options.shadow) requireWithin(0.0, 1.0, "shadow", *options.shadow, faults);
  requireWithin(0.0, 100.0, "background_speed", options.background_speed, faults);
  checkOcclusions(options, faults);
  return faults;
}

}  // namespace chain_tracker
