// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/link_width.h"

#include <algorithm>
#include <cmath>

#include "chain_tracker/image/pixel_geometry.h"
#include "stroke_reach.h"

namespace chain_tracker {
namespace {

// Fractions of the mean length of the edges.
constexpr double kAxisWidth = 0.1;   // surely on the object
constexpr double kRingStart = 0.25;  // from there on, what differs from the axis is not the object
constexpr double kRingEnd = 0.7;
// Fractions of an edge's length.
constexpr double kFarthest = 0.5;  // looked at to each side
/// Near its ends an edge passes into its neighbours.
constexpr double kFirst = 0.15;
constexpr double kLast = 0.85;
constexpr int kSamples = 36;
/// Of the samples beside an edge that have the colours of the axis as far as the object reaches.
/// Rather too narrow than too wide: what lies beside the object stays where it is when it moves.
constexpr double kMostInside = 0.75;
/// Windows that straddle the outline should show more of the object than of what lies beside it.
constexpr double kCovered = 0.85;
/// The aspects that cells cover well.
constexpr double kNarrowestAspect = 0.14;
constexpr double kWidestAspect = 0.5;

/// Fractions of the lengths of the edges.
std::vector<StrokeReach> reachesOf(const cv::Mat1b& colors,
                                   const std::vector<cv::Point2d>& polyline) {
  std::vector<StrokeReach> reaches;
  for (size_t i = 1; i < polyline.size(); ++i) {
    const double length = cv::norm(polyline[i] - polyline[i - 1]);
    const std::vector<StrokeSample> samples =
        samplesBetween(polyline[i - 1], polyline[i], kFirst, kLast, kSamples);
    const StrokeReach reach = reachOf(colors, samples, kMostInside, kFarthest * length);
    reaches.push_back({reach.left / length, reach.right / length});
  }
  return reaches;
}

double medianOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

/// Of the whole object: neighbours on some sides do not change it.
double commonWidth(const std::vector<StrokeReach>& reaches) {
  std::vector<double> all;
  for (const StrokeReach& reach : reaches) {
    all.push_back(reach.left);
    all.push_back(reach.right);
  }
  return 2.0 * medianOf(std::move(all));
}

}  // namespace

std::vector<double> measureAspects(const cv::Mat& image, const std::vector<cv::Point2d>& polyline) {
  const double length = lengthOf(polyline) / static_cast<double>(polyline.size() - 1);
  const cv::Mat1b colors = axisColors(
      image, polyline, {0.5 * kAxisWidth * length, kRingStart * length, kRingEnd * length});
  const std::vector<StrokeReach> reaches = reachesOf(colors, polyline);
  const double common = commonWidth(reaches);
  if (common <= 0.0 || common >= 2.0 * kFarthest) return {};
  std::vector<double> aspects;
  for (const StrokeReach& reach : reaches) {
    const double between = std::sqrt(common * reach.width());
    aspects.push_back(std::clamp(kCovered * between, kNarrowestAspect, kWidestAspect));
  }
  return aspects;
}

ChainModel withMeasuredAspects(ChainModel model, const cv::Mat& image,
                               const std::vector<cv::Point2d>& polyline) {
  const auto asks = [](const SegmentModel& segment) { return segment.measure_aspect; };
  if (polyline.size() != model.segments.size() + 1 ||
      std::none_of(model.segments.begin(), model.segments.end(), asks)) {
    return model;
  }
  const std::vector<double> aspects = measureAspects(image, polyline);
  for (size_t m = 0; m < aspects.size(); ++m) {
    if (model.segments[m].measure_aspect) model.segments[m].aspect = aspects[m];
  }
  return model;
}

}  // namespace chain_tracker
