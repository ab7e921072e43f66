// SPDX-License-Identifier: BSD-3-Clause
#include "line_width.h"

#include <algorithm>

#include "chain_tracker/image/pixel_geometry.h"
#include "stroke_reach.h"
#include "upper_median.h"

namespace chain_tracker {
namespace {

using Polyline = std::vector<cv::Point2d>;

// Fractions of the length of the line.
constexpr double kAxisWidth = 0.005;
constexpr double kFarthest = 0.125;
constexpr double kRingStart = 0.13;
constexpr double kRingEnd = 0.3;
/// What tapers is measured piece by piece.
constexpr size_t kPieces = 12;
constexpr size_t kSamplesPerPiece = 36;
/// Of a piece's samples: rather too thin than too thick.
constexpr double kMostInside = 0.75;
/// Side of a window, of the thickness: where a line is as thick as that, its windows reach from its
/// middle nearly to its outline, and show it when they move aside.
constexpr double kWindow = 0.65;
/// Windows overlap: steps of the line to a window.
constexpr double kSteps = 2.0;

std::vector<StrokeSample> samplesAlong(const Polyline& polyline, double length) {
  std::vector<StrokeSample> samples;
  for (size_t i = 1; i < polyline.size(); ++i) {
    const double share = cv::norm(polyline[i] - polyline[i - 1]) / length;
    const int points = 2 + cvRound(share * kPieces * kSamplesPerPiece);
    const auto more = samplesBetween(polyline[i - 1], polyline[i], 0.0, 1.0, points);
    samples.insert(samples.end(), more.begin(), more.end());
  }
  return samples;
}

/// To what the line lies on, if that is thicker.
void widenWindows(const cv::Mat& image, const Polyline& line, SegmentModel& segment) {
  const double length = lengthOf(line);
  const double side = kWindow * measureThickness(image, line);
  if (side <= segment.window * length / (segment.parts - 1)) return;
  segment.parts = std::min(1 + cvRound(kSteps * length / side), segment.parts);
  segment.window = side * (segment.parts - 1) / length;
}

}  // namespace

double measureThickness(const cv::Mat& image, const Polyline& polyline) {
  const double length = lengthOf(polyline);
  const cv::Mat1b colors =
      axisColors(image, polyline, {kAxisWidth * length, kRingStart * length, kRingEnd * length});
  const std::vector<StrokeSample> samples = samplesAlong(polyline, length);
  std::vector<double> widths;
  for (size_t i = 0; i < kPieces; ++i) {
    const auto at = [&](size_t piece) {
      return samples.begin() + static_cast<std::ptrdiff_t>(piece * samples.size() / kPieces);
    };
    widths.push_back(reachOf(colors, {at(i), at(i + 1)}, kMostInside, kFarthest * length).width());
  }
  const double thickness = takeUpperMedian(widths);
  return thickness < 2.0 * kFarthest * length ? thickness : 0.0;
}

ChainModel withMeasuredWindows(ChainModel model, const cv::Mat& image, const Polyline& polyline) {
  const bool is_joined = model.segments.size() > 1;
  if (is_joined && polyline.size() != model.segments.size() + 1) return model;
  for (size_t m = 0; m < model.segments.size(); ++m) {
    SegmentModel& segment = model.segments[m];
    if (!segment.measure_window) continue;
    widenWindows(image, is_joined ? Polyline{polyline[m], polyline[m + 1]} : polyline, segment);
  }
  return model;
}

}  // namespace chain_tracker
