// SPDX-License-Identifier: BSD-3-Clause
/// Conventions of the whole package, stated once.
///
/// - A point is (x right, y down) in pixels; the origin is the centre of the top-left pixel.
/// - An angle is in radians, measured from +x towards +y (clockwise as the image is seen).
/// - A scale is dimensionless; 1 is the size at initialisation.
/// - A window of side a [px] centred at p covers the pixels from p - (a - 1) / 2 to p + (a - 1)
/// / 2.
/// - A map holds costs: smaller is better, +infinity is forbidden.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace chain_tracker {

/// The angle in (-pi, pi] that equals `angle` [rad] up to whole turns.
double wrapAngle(double angle);

/// The direction of a vector [rad], in (-pi, pi]; 0 for the null vector.
double directionOf(const cv::Point2d& vector);

/// Similarity transform from an object's frame to the image: x -> scale R(angle) x + translation.
struct Similarity {
  double angle = 0.0;       ///< [rad]
  double scale = 1.0;       ///< > 0
  cv::Point2d translation;  ///< [px], the image of the frame's origin

  cv::Point2d apply(const cv::Point2d& point) const;
  /// The point of the object's frame whose image is `point`.
  cv::Point2d applyInverse(const cv::Point2d& point) const;
};

/// The smallest upright box that holds all points; the points must not be empty.
cv::Rect2d uprightBounds(const std::vector<cv::Point2d>& points);

/// Of a polyline [px]; 0 of less than two points.
double lengthOf(const std::vector<cv::Point2d>& polyline);

}  // namespace chain_tracker
