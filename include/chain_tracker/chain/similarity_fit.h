// SPDX-License-Identifier: BSD-3-Clause
/// Weighted least-squares similarity between two point sets (Umeyama 1991): the pose update of
/// thesis ch. 3.4.3.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/image/pixel_geometry.h"

namespace chain_tracker {

/// The T that minimises sum_k weight_k |to_k - T(from_k)|^2. O(points).
/// Needs equally many points and weights, weights >= 0 with a positive sum. If the weighted `from`
/// all coincide, angle 0 and scale 1.
Similarity fitSimilarity(const std::vector<cv::Point2d>& from, const std::vector<cv::Point2d>& to,
                         const std::vector<double>& weights);

/// `robust` becomes the weights with which fitSimilarity() heeds the bulk of the points: of a point
/// that lies an error e off that fit, the given one over (1 + (e / tolerance)^2)^2 (iteratively
/// reweighted least squares with the estimator of Geman and McClure 1985). `tolerance` > 0 [px].
/// O(points).
void robustWeights(const std::vector<cv::Point2d>& from, const std::vector<cv::Point2d>& to,
                   const std::vector<double>& weights, double tolerance,
                   std::vector<double>& robust);

/// The translation that fits best for a given angle and scale.
cv::Point2d fitTranslation(const std::vector<cv::Point2d>& from, const std::vector<cv::Point2d>& to,
                           const std::vector<double>& weights, double angle, double scale);

}  // namespace chain_tracker
