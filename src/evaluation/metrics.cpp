// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/evaluation/metrics.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

#include "occlusion_recovery.h"

namespace chain_tracker {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr int kSuccessThresholds = 21;
constexpr double kPascalOverlap = 0.5;
constexpr double kPrecisionRadius = 20.0;
constexpr double kPckShare = 0.1;

template <typename Predicate>
double shareOf(const std::vector<double>& values, Predicate predicate) {
  if (values.empty()) return kUnknown;
  const auto count = std::count_if(values.begin(), values.end(), predicate);
  return static_cast<double>(count) / static_cast<double>(values.size());
}

std::vector<double> finiteOnly(const std::vector<double>& values) {
  std::vector<double> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
               [](double x) { return std::isfinite(x); });
  return finite;
}

cv::Point2d centerOf(const cv::Rect2d& box) {
  return {box.x + 0.5 * box.width, box.y + 0.5 * box.height};
}

}  // namespace

double intersectionOverUnion(const cv::Rect2d& a, const cv::Rect2d& b) {
  const double common = (a & b).area();
  const double all = a.area() + b.area() - common;
  return common > 0.0 ? common / all : 0.0;
}

double centerDistance(const cv::Rect2d& a, const cv::Rect2d& b) {
  return cv::norm(centerOf(a) - centerOf(b));
}

std::vector<double> successCurve(const std::vector<double>& overlaps) {
  std::vector<double> curve;
  for (int i = 0; i < kSuccessThresholds; ++i) {
    const double threshold = static_cast<double>(i) / (kSuccessThresholds - 1);
    curve.push_back(shareOf(overlaps, [&](double x) { return x > threshold; }));
  }
  return curve;
}

double successAuc(const std::vector<double>& overlaps) { return mean(successCurve(overlaps)); }

double mean(const std::vector<double>& values) {
  if (values.empty()) return kUnknown;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double percentile(std::vector<double> values, double p) {
  if (values.empty()) return kUnknown;
  std::sort(values.begin(), values.end());
  const double rank = p * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(std::floor(rank));
  const auto high = std::min(low + 1, values.size() - 1);
  const double part = rank - std::floor(rank);
  return part == 0.0 ? values[low] : values[low] + part * (values[high] - values[low]);
}

double shareWithin(const std::vector<double>& values, double limit) {
  return shareOf(values, [&](double x) { return x <= limit; });
}

Scores summarize(const std::vector<FrameScore>& frames, double object_length,
                 const std::vector<double>& times_ms) {
  Scores scores;
  std::vector<double> overlaps;
  std::vector<double> distances;
  std::vector<double> point_errors;
  bool was_lost = false;
  OcclusionRecovery recovery(kPckShare * object_length);
  for (const FrameScore& frame : frames) {
    ++scores.frames;
    const bool found_again = was_lost && !frame.lost && frame.overlap > 0.0;
    was_lost = frame.lost;
    point_errors.insert(point_errors.end(), frame.point_errors.begin(), frame.point_errors.end());
    recovery.observe(frame);
    if (!frame.has_object) continue;
    ++scores.scored_frames;
    overlaps.push_back(frame.overlap);
    distances.push_back(frame.center_error);
    scores.lost_frames += frame.lost ? 1 : 0;
    scores.reacquired += found_again ? 1 : 0;
  }
  scores.mean_iou = mean(overlaps);
  scores.success_auc = successAuc(overlaps);
  scores.pascal_50 = shareOf(overlaps, [](double x) { return x > kPascalOverlap; });
  scores.precision_20px = shareWithin(distances, kPrecisionRadius);
  scores.mean_center_error_px = mean(finiteOnly(distances));
  const std::vector<double> known_errors = finiteOnly(point_errors);
  scores.part_error_mean_px = mean(known_errors);
  scores.part_error_median_px = percentile(known_errors, 0.5);
  scores.part_error_p95_px = percentile(known_errors, 0.95);
  scores.pck_10 = shareWithin(point_errors, kPckShare * object_length);
  scores.occlusions = recovery.occlusions();
  scores.occlusions_recovered = recovery.recovered();
  scores.latency_p50_ms = percentile(times_ms, 0.5);
  scores.latency_p99_ms = percentile(times_ms, 0.99);
  scores.fps = 1000.0 / mean(times_ms);
  return scores;
}

}  // namespace chain_tracker
