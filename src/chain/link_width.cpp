// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/link_width.h"

#include <algorithm>
#include <cmath>

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/image/color_palette.h"
#include "chain_tracker/image/frame_pixels.h"

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
constexpr double kReachStep = 0.5;  // [px]
/// Of the samples beside an edge that have the colours of the axis as far as the object reaches.
/// Rather too narrow than too wide: what lies beside the object stays where it is when it moves.
constexpr double kMostInside = 0.75;
/// Windows that straddle the outline should show more of the object than of what lies beside it.
constexpr double kCovered = 0.85;
/// The aspects that cells cover well.
constexpr double kNarrowestAspect = 0.14;
constexpr double kWidestAspect = 0.5;
constexpr int kPaletteColors = 24;
constexpr double kObjectShare = 0.5;

/// How far the colours of the axis reach to both sides of an edge, fractions of its length.
struct Reach {
  double left = 0.0;
  double right = 0.0;

  /// A side on which something of the same colours lies says little.
  double width() const { return std::min(left + right, 3.0 * std::min(left, right)); }
};

double meanEdgeLength(const std::vector<cv::Point2d>& polyline) {
  double length = 0.0;
  for (size_t i = 1; i < polyline.size(); ++i) length += cv::norm(polyline[i] - polyline[i - 1]);
  return length / static_cast<double>(polyline.size() - 1);
}

/// Not 0 where a pixel has a colour of the axis.
cv::Mat1b axisColors(const cv::Mat& image, const std::vector<cv::Point2d>& polyline) {
  const double length = meanEdgeLength(polyline);
  const auto stroke = [&](double width) {
    return maskOf({polyline, std::max(3.0, width * length)}, {{}, image.size()}, 0.0);
  };
  cv::Mat1b ring = stroke(2.0 * kRingEnd);
  ring.setTo(0, stroke(2.0 * kRingStart));
  const ColorPalette palette(image, stroke(kAxisWidth), ring, {kPaletteColors, kObjectShare});
  FramePixels pixels(palette, image);
  cv::Mat1b colors;
  cv::compare(pixels.entries(cv::Rect(cv::Point(), image.size())), ColorPalette::kOther, colors,
              cv::CMP_NE);
  return colors;
}

/// Share of the samples along an edge, moved aside, that have the colours of the axis.
double shareBeside(const cv::Mat1b& colors, const cv::Point2d& start, const cv::Point2d& edge,
                   const cv::Point2d& aside) {
  const cv::Rect image(cv::Point(), colors.size());
  int inside = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double t = kFirst + (kLast - kFirst) * i / (kSamples - 1);
    const cv::Point pixel = start + t * edge + aside;
    if (image.contains(pixel) && colors(pixel) != 0) ++inside;
  }
  return static_cast<double>(inside) / kSamples;
}

/// To the side of the normal, which is as long as the edge.
double reachBeside(const cv::Mat1b& colors, const cv::Point2d& start, const cv::Point2d& edge,
                   const cv::Point2d& normal) {
  const double step = kReachStep / cv::norm(edge);
  double reach = 0.0;
  while (reach < kFarthest && shareBeside(colors, start, edge, reach * normal) >= kMostInside) {
    reach += step;
  }
  return reach;
}

std::vector<Reach> reachesOf(const cv::Mat1b& colors, const std::vector<cv::Point2d>& polyline) {
  std::vector<Reach> reaches;
  for (size_t i = 1; i < polyline.size(); ++i) {
    const cv::Point2d edge = polyline[i] - polyline[i - 1];
    const cv::Point2d normal(-edge.y, edge.x);
    reaches.push_back({reachBeside(colors, polyline[i - 1], edge, normal),
                       reachBeside(colors, polyline[i - 1], edge, -normal)});
  }
  return reaches;
}

double medianOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

/// Of the whole object: neighbours on some sides do not change it.
double commonWidth(const std::vector<Reach>& reaches) {
  std::vector<double> all;
  for (const Reach& reach : reaches) {
    all.push_back(reach.left);
    all.push_back(reach.right);
  }
  return 2.0 * medianOf(std::move(all));
}

}  // namespace

std::vector<double> measureAspects(const cv::Mat& image, const std::vector<cv::Point2d>& polyline) {
  const std::vector<Reach> reaches = reachesOf(axisColors(image, polyline), polyline);
  const double common = commonWidth(reaches);
  if (common <= 0.0 || common >= 2.0 * kFarthest) return {};
  std::vector<double> aspects;
  for (const Reach& reach : reaches) {
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
