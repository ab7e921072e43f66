// SPDX-License-Identifier: BSD-3-Clause
#include "light_change.h"

#include <algorithm>
#include <cmath>

#include "upper_median.h"

namespace chain_tracker {
namespace {

constexpr size_t kFewestParts = 3;
/// Of the object in what a part was learned from.
constexpr double kLeastShare = 0.2;
/// Of that, that must still be seen.
constexpr double kLeastSeen = 0.5;
/// Of a dark channel the ratio is noise [grey levels].
constexpr double kNoise = 2.0;

constexpr double kUnit = ChannelGains::kUnit;
/// Changes are remembered farther than they can be undone: back again is where they came from.
constexpr double kMostGain = 8.0;
constexpr double kLeastGain = 1.0 / kMostGain;

bool canTell(const ObjectColor& learned, const ObjectColor& seen) {
  return learned.share >= kLeastShare && seen.share >= kLeastSeen * learned.share;
}

}  // namespace

void LightChange::observe(const std::vector<ObjectColor>& learned,
                          const std::vector<ObjectColor>& seen) {
  for (int channel = 0; channel < 3; ++channel) {
    ratios_.clear();
    for (size_t k = 0; k < learned.size(); ++k) {
      if (!canTell(learned[k], seen[k])) continue;
      ratios_.push_back((learned[k].mean[channel] + kNoise) / (seen[k].mean[channel] + kNoise));
    }
    if (ratios_.size() < kFewestParts) return;
    double& gain = gains_[static_cast<size_t>(channel)];
    gain += rate_ * (std::clamp(takeUpperMedian(ratios_), kLeastGain, kMostGain) - gain);
  }
}

void LightChange::jump(const cv::Vec3d& ratios) {
  for (int channel = 0; channel < 3; ++channel) {
    double& gain = gains_[static_cast<size_t>(channel)];
    gain = std::clamp(gain / ratios[channel], kLeastGain, kMostGain);
  }
}

ChannelGains LightChange::gains() const {
  ChannelGains gains;
  for (size_t c = 0; c < gains_.size(); ++c) {
    gains.steps[c] = std::clamp(static_cast<int>(std::lround(gains_[c] * kUnit)),
                                ChannelGains::kLeast, ChannelGains::kMost);
  }
  return gains;
}

}  // namespace chain_tracker
