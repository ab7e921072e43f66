// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/similarity_fit.h"

#include <cmath>

namespace chain_tracker {
namespace {

/// Points within this distance of their mean coincide but for rounding [px].
constexpr double kCoincident = 1e-9;
/// Of reweighting.
constexpr int kRounds = 3;

cv::Point2d weightedMean(const std::vector<cv::Point2d>& points,
                         const std::vector<double>& weights) {
  cv::Point2d sum;
  double total = 0.0;
  for (size_t k = 0; k < points.size(); ++k) {
    sum += weights[k] * points[k];
    total += weights[k];
  }
  return sum / total;
}

}  // namespace

Similarity fitSimilarity(const std::vector<cv::Point2d>& from, const std::vector<cv::Point2d>& to,
                         const std::vector<double>& weights) {
  const cv::Point2d from_mean = weightedMean(from, weights);
  const cv::Point2d to_mean = weightedMean(to, weights);
  double total = 0.0;
  double spread = 0.0;
  double dot = 0.0;
  double cross = 0.0;
  for (size_t k = 0; k < from.size(); ++k) {
    const cv::Point2d a = from[k] - from_mean;
    const cv::Point2d b = to[k] - to_mean;
    total += weights[k];
    spread += weights[k] * a.dot(a);
    dot += weights[k] * a.dot(b);
    cross += weights[k] * a.cross(b);
  }
  Similarity fit;
  if (spread > total * kCoincident * kCoincident) {
    fit.angle = std::atan2(cross, dot);
    fit.scale = std::hypot(dot, cross) / spread;
  }
  fit.translation = to_mean - Similarity{fit.angle, fit.scale, {}}.apply(from_mean);
  return fit;
}

void robustWeights(const std::vector<cv::Point2d>& from, const std::vector<cv::Point2d>& to,
                   const std::vector<double>& weights, double tolerance,
                   std::vector<double>& robust) {
  robust = weights;
  for (int round = 0; round < kRounds; ++round) {
    const Similarity fit = fitSimilarity(from, to, robust);
    for (size_t k = 0; k < from.size(); ++k) {
      const double error = cv::norm(to[k] - fit.apply(from[k])) / tolerance;
      const double share = 1.0 / (1.0 + error * error);
      robust[k] = weights[k] * share * share;
    }
  }
}

cv::Point2d fitTranslation(const std::vector<cv::Point2d>& from, const std::vector<cv::Point2d>& to,
                           const std::vector<double>& weights, double angle, double scale) {
  return weightedMean(to, weights) -
         Similarity{angle, scale, {}}.apply(weightedMean(from, weights));
}

}  // namespace chain_tracker
