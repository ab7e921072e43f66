// SPDX-License-Identifier: BSD-3-Clause
#include "scene_motion.h"

#include <algorithm>
#include <cmath>

namespace chain_tracker {
namespace {

/// Weights and frequency ratios of the sines of SmoothMotion.
constexpr double kWeights[3] = {0.6, 0.3, 0.1};
constexpr double kRatios[3] = {1.0, 1.7, 2.9};

/// Frames over which a burst's shift fades, and in which the object leaves or comes back.
constexpr int kFadeFrames = 90;
constexpr double kLeavingFrames = 40.0;
/// Of what is out of view [px]: room for blur.
constexpr double kExitMargin = 10.0;

/// From 0 to 1 without a jerk.
double smoothStep(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

double activeRate(const std::vector<SceneBurst>& bursts, int frame, bool& active) {
  double rate = 0.0;
  for (const SceneBurst& burst : bursts) {
    if (frame < burst.start || frame >= burst.start + burst.length) continue;
    rate += burst.rate;
    active = true;
  }
  return rate;
}

int lastFrame(const SceneOptions& options) {
  int last = 0;
  for (const SceneBurst& burst : options.shift_bursts) {
    last = std::max(last, burst.start + burst.length + kFadeFrames);
  }
  for (const SceneBurst& burst : options.rotation_bursts) {
    last = std::max(last, burst.start + burst.length);
  }
  return last;
}

/// The heading nearest to the last one that stays within `allowed`.
double nextHeading(const cv::Point2d& from, double heading, double rate,
                   const cv::Point2d& allowed) {
  for (const double turn : {0.0, 0.4, -0.4, 0.9, -0.9, 1.5, -1.5, 2.2, -2.2}) {
    const double tried = heading + turn;
    const cv::Point2d to = from + rate * cv::Point2d(std::cos(tried), std::sin(tried));
    if (std::abs(to.x) <= allowed.x && std::abs(to.y) <= allowed.y) return tried;
  }
  return directionOf(-from);
}

}  // namespace

SmoothMotion::SmoothMotion(double cycles, cv::RNG& rng) : cycles_(cycles) {
  for (double& phase : phases_) phase = rng.uniform(0.0, 2.0 * CV_PI);
}

double SmoothMotion::at(double time) const {
  const double t = 2.0 * CV_PI * cycles_ * time;
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) sum += kWeights[i] * std::sin(kRatios[i] * t + phases_[i]);
  return sum;
}

double SmoothMotion::fastestStep() const {
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) sum += kWeights[i] * kRatios[i];
  return sum * 2.0 * CV_PI * cycles_ / kFramesPerTime;
}

BurstPath::BurstPath(const SceneOptions& options, cv::RNG& rng) : steps_(1) {
  const cv::Point2d allowed(0.25 * options.size.width, 0.25 * options.size.height);
  double heading = rng.uniform(-CV_PI, CV_PI);
  cv::Point2d fading;
  int quiet = 0;
  for (int frame = 0; frame < lastFrame(options); ++frame) {
    Step step = steps_.back();
    bool shifting = false;
    bool turning = false;
    const double rate = activeRate(options.shift_bursts, frame, shifting);
    step.angle += activeRate(options.rotation_bursts, frame, turning);
    if (shifting) {
      heading = nextHeading(step.shift, heading, rate, allowed);
      step.shift += rate * cv::Point2d(std::cos(heading), std::sin(heading));
      fading = step.shift;
      quiet = 0;
    } else if (!turning) {
      step.shift = fading * (1.0 - smoothStep(++quiet / static_cast<double>(kFadeFrames)));
    }
    if (!shifting && !turning) step.clock += 1.0;
    steps_.push_back(step);
  }
}

BurstPath::Step BurstPath::at(double frame) const {
  const double last = static_cast<double>(steps_.size() - 1);
  if (frame <= 0.0) return {frame, 0.0, {}};
  if (frame >= last) {
    Step step = steps_.back();
    step.clock += frame - last;
    return step;
  }
  const size_t before = static_cast<size_t>(frame);
  const double share = frame - static_cast<double>(before);
  const Step& a = steps_[before];
  const Step& b = steps_[before + 1];
  return {a.clock + share * (b.clock - a.clock), a.angle + share * (b.angle - a.angle),
          a.shift + share * (b.shift - a.shift)};
}

PoseMotion::PoseMotion(const SceneOptions& options, const MotionRange& range, double radius,
                       cv::RNG& rng)
    : options_(options),
      range_(range),
      x_(1.5, rng),
      y_(1.2, rng),
      turn_(2.0, rng),
      growth_(1.0, rng),
      exit_(rng.uniform(0, 2) == 0 ? -1.0 : 1.0, 0.0),
      bursts_(options, rng) {
  exit_ *= exitDistance(radius);
}

double PoseMotion::exitDistance(double radius) const {
  double distance = 0.0;
  for (int frame = options_.leave_at; frame < options_.leave_at + options_.leave_for; ++frame) {
    const Similarity pose = atHome(frame).image_from_object;
    const double margin = radius * pose.scale + kExitMargin;
    const double inside =
        exit_.x > 0.0 ? options_.size.width - pose.translation.x : pose.translation.x;
    distance = std::max(distance, inside + margin);
  }
  return distance;
}

cv::Point2d PoseMotion::awayAt(double frame) const {
  if (options_.leave_for <= 0) return {};
  const double going = smoothStep((frame - options_.leave_at) / kLeavingFrames + 1.0);
  const double coming =
      smoothStep((frame - options_.leave_at - options_.leave_for + 1.0) / kLeavingFrames);
  return exit_ * (going - coming);
}

ObjectState PoseMotion::at(double frame) const {
  ObjectState state = atHome(frame);
  state.image_from_object.translation += awayAt(frame);
  return state;
}

ObjectState PoseMotion::atHome(double frame) const {
  const BurstPath::Step burst = bursts_.at(frame);
  const double time = burst.clock / kFramesPerTime;
  const double travel = time * options_.speed;
  const cv::Point2d home(options_.size.width * (range_.center.x + range_.reach.x * x_.at(travel)),
                         options_.size.height * (range_.center.y + range_.reach.y * y_.at(travel)));
  const double turn = options_.rotation / turn_.fastestStep() * range_.turn * turn_.at(time);
  const Similarity pose{range_.angle + turn + burst.angle,
                        std::pow(options_.scale_range, growth_.at(time)), home + burst.shift};
  return {pose, travel, time};
}

}  // namespace chain_tracker
