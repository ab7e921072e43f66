// SPDX-License-Identifier: BSD-3-Clause
#include "light_jump.h"

#include <cmath>
#include <cstddef>

#include <opencv2/imgproc.hpp>

#include "upper_median.h"

namespace chain_tracker {
namespace {

/// Pixels that are compared, evenly over the image.
const cv::Size kSamples(48, 36);
constexpr std::size_t kFewestSamples = 200;
/// Of a jump, log ratio: clips with moving cameras stay below half of that.
constexpr double kLeastJump = 0.08;
/// Of the mean level, below which it is not looked at any closer.
constexpr double kLeastChange = 0.04;
/// Between the median pixel and the others, of the jump: where a camera swings round, it is more.
constexpr double kMostSpread = 2.0;
/// Levels of which noise and the ends of the range leave a ratio [grey levels].
constexpr int kDarkest = 12;
constexpr int kLightest = 243;
/// Of a dark pixel the ratio is noise [grey levels].
constexpr double kNoise = 2.0;

bool tells(int level) { return level >= kDarkest && level <= kLightest; }

}  // namespace

LightJump::LightJump(const cv::Mat& image) { observe(image); }

cv::Vec3d LightJump::observe(const cv::Mat& image) {
  cv::resize(image, now_, kSamples, 0.0, 0.0, cv::INTER_NEAREST);
  cv::Vec3d logs;
  if (!before_.empty() && hasChanged()) {
    for (int channel = 0; channel < now_.channels(); ++channel) logs[channel] = logRatioOf(channel);
    if (now_.channels() == 1) logs = cv::Vec3d::all(logs[0]);
  }
  cv::swap(before_, now_);
  if (cv::norm(logs, cv::NORM_INF) < kLeastJump) return cv::Vec3d::all(1.0);
  return {std::exp(logs[0]), std::exp(logs[1]), std::exp(logs[2])};
}

bool LightJump::hasChanged() const {
  const cv::Scalar before = cv::mean(before_);
  const cv::Scalar now = cv::mean(now_);
  return cv::norm(now - before, cv::NORM_INF) > kLeastChange * cv::norm(before, cv::NORM_INF);
}

/// 0 where the pixels do not agree.
double LightJump::logRatioOf(int channel) {
  logs_.clear();
  const int channels = now_.channels();
  for (int row = 0; row < now_.rows; ++row) {
    const uchar* const before = before_.ptr(row) + channel;
    const uchar* const now = now_.ptr(row) + channel;
    for (int i = 0; i < now_.cols * channels; i += channels) {
      if (!tells(before[i]) || !tells(now[i])) continue;
      logs_.push_back(std::log((now[i] + kNoise) / (before[i] + kNoise)));
    }
  }
  if (logs_.size() < kFewestSamples) return 0.0;
  const double median = takeUpperMedian(logs_);
  for (double& log : logs_) log = std::abs(log - median);
  return takeUpperMedian(logs_) <= kMostSpread * std::abs(median) ? median : 0.0;
}

}  // namespace chain_tracker
