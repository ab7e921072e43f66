// SPDX-License-Identifier: BSD-3-Clause
/// How far what a stroke was drawn along reaches to both sides of it: as far as the colours that
/// the stroke itself lies on and that are rarer farther away.
#pragma once

#include <algorithm>
#include <vector>

#include <opencv2/core.hpp>

namespace chain_tracker {

/// A place on the stroke, and the unit vector across it.
struct StrokeSample {
  cv::Point2d point;
  cv::Point2d normal;
};

/// To the two sides of a piece of the stroke [px].
struct StrokeReach {
  double left = 0.0;
  double right = 0.0;

  /// A side on which something of the same colours lies says little.
  double width() const { return std::min(left + right, 3.0 * std::min(left, right)); }
};

/// Distances from the stroke [px]: surely on the object up to `axis`; what differs from that
/// between `ring_start` and `ring_end` is not the object.
struct StrokeRing {
  double axis;
  double ring_start;
  double ring_end;
};

/// `points` in equal steps from fraction `first` to fraction `last` of the way between two points.
std::vector<StrokeSample> samplesBetween(const cv::Point2d& from, const cv::Point2d& to,
                                         double first, double last, int points);

/// Not 0 where a pixel of the image, CV_8UC3 or CV_8UC1, has a colour of the axis; 0 everywhere if
/// all of that lies outside.
cv::Mat1b axisColors(const cv::Mat& image, const std::vector<cv::Point2d>& stroke,
                     const StrokeRing& ring);

/// Up to where less than `least_share` of the samples, moved aside, have a colour of the axis; at
/// most about `farthest` [px]. O(samples * farthest).
StrokeReach reachOf(const cv::Mat1b& colors, const std::vector<StrokeSample>& samples,
                    double least_share, double farthest);

}  // namespace chain_tracker
