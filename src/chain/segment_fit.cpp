// SPDX-License-Identifier: BSD-3-Clause
#include "segment_fit.h"

#include <algorithm>
#include <cmath>

#include "chain_tracker/chain/similarity_fit.h"
#include "chain_tracker/image/pixel_geometry.h"

namespace chain_tracker {
namespace {

/// Of a part to where the fit has it, of its window's side: one farther off counts less than a
/// quarter.
constexpr double kTolerance = 0.3;
/// Of the log scale, where nothing tells it, to both sides of that of the first frame.
constexpr double kScaleSpread = 0.2;
/// Keeps the fit defined when no part is seen.
constexpr double kSmallestWeight = 1e-3;

/// Length of the chain found over that of the reference. What coils up comes nearer to its middle
/// without becoming shorter: a similarity would take that for a smaller scale. 1 where the parts of
/// the reference coincide, as two of a line that doubles back may.
double lengthRatio(const std::vector<cv::Point2d>& reference, const std::vector<cv::Point2d>& found,
                   const std::vector<double>& weights) {
  double reference_length = 0.0;
  double found_length = 0.0;
  for (size_t k = 1; k < found.size(); ++k) {
    const double weight = std::min(weights[k - 1], weights[k]);
    reference_length += weight * cv::norm(reference[k] - reference[k - 1]);
    found_length += weight * cv::norm(found[k] - found[k - 1]);
  }
  return reference_length > 0.0 ? found_length / reference_length : 1.0;
}

/// Inverse variance of the log scale in a fit of parts whose errors are independent.
double scaleInformation(const SegmentParts& parts, const cv::Point2d& center) {
  double information = 0.0;
  for (const PartState& part : parts) {
    const cv::Vec2d arm = part.position - center;
    const double length = cv::norm(arm);
    // A part's errors towards the centre and away from it.
    const double variance = arm.dot(part.covariance * arm) / (length * length);
    if (variance > 0.0) information += part.confidence * length * length / variance;
  }
  return information;
}

/// As the parts tell it and, as far as they do not, as in the first frame.
double remembered(double scale, double information) {
  const double prior = 1.0 / (kScaleSpread * kScaleSpread);
  return std::pow(scale, information / (information + prior));
}

double clampedTurn(double from, double to, double limit) {
  return wrapAngle(from + std::clamp(wrapAngle(to - from), -limit, limit));
}

double clampedScale(double from, double to, double limit) {
  return from * std::exp(std::clamp(std::log(to / from), -limit, limit));
}

}  // namespace

Similarity fitSegment(const SegmentLayout& layout, const PoseGrid& poses, const SegmentParts& parts,
                      double length_rate, SegmentFitWorkspace& workspace) {
  const SegmentPose& searched = poses.middle;
  auto& [reference, found, confidences, weights] = workspace;
  reference.clear();
  found.clear();
  confidences.clear();
  for (size_t k = 0; k < parts.size(); ++k) {
    reference.push_back(layout.parts[k].position);
    found.push_back(parts[k].position);
    confidences.push_back(parts[k].confidence + kSmallestWeight);
  }
  const bool is_deformable = layout.layout == Layout::kDeformable;
  if (is_deformable) {
    weights = confidences;
  } else {
    const double side = layout.parts.front().side * searched.scale;
    robustWeights(reference, found, confidences, kTolerance * side, weights);
  }
  Similarity fit = fitSimilarity(reference, found, weights);
  if (is_deformable) {
    const double change = lengthRatio(reference, found, weights) / searched.scale;
    fit.scale = searched.scale * std::pow(change, length_rate);
  } else if (poses.scales == 1) {
    fit.scale = remembered(fit.scale, scaleInformation(parts, fit.translation));
  }
  const double angle = clampedTurn(searched.orientation, fit.angle, 0.5 * poses.orientation_step);
  const double scale = clampedScale(searched.scale, fit.scale, 0.5 * poses.scale_step);
  return {angle, scale, fitTranslation(reference, found, weights, angle, scale)};
}

}  // namespace chain_tracker
