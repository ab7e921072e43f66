// SPDX-License-Identifier: BSD-3-Clause
#include "stroke_reach.h"

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/image/color_palette.h"
#include "chain_tracker/image/frame_pixels.h"

namespace chain_tracker {
namespace {

constexpr double kReachStep = 0.5;  // [px]
constexpr double kThinnest = 3.0;   // stroke that is drawn [px]
constexpr int kPaletteColors = 24;
constexpr double kObjectShare = 0.5;

/// `side`: 1 or -1, along the normals.
double reachBeside(const cv::Mat1b& colors, const std::vector<StrokeSample>& samples, double side,
                   double least_share, double farthest) {
  const cv::Rect image(cv::Point(), colors.size());
  const auto has_colors = [&](double reach) {
    const auto inside = std::count_if(samples.begin(), samples.end(), [&](const StrokeSample& at) {
      const cv::Point pixel = at.point + side * reach * at.normal;
      return image.contains(pixel) && colors(pixel) != 0;
    });
    return static_cast<double>(inside) >= least_share * static_cast<double>(samples.size());
  };
  double reach = 0.0;
  while (reach < farthest && has_colors(reach)) reach += kReachStep;
  return reach;
}

}  // namespace

std::vector<StrokeSample> samplesBetween(const cv::Point2d& from, const cv::Point2d& to,
                                         double first, double last, int points) {
  const cv::Point2d edge = to - from;
  const cv::Point2d normal = cv::Point2d(-edge.y, edge.x) / cv::norm(edge);
  std::vector<StrokeSample> samples;
  samples.reserve(static_cast<size_t>(points));
  for (int i = 0; i < points; ++i) {
    samples.push_back({from + edge * (first + (last - first) * i / (points - 1)), normal});
  }
  return samples;
}

cv::Mat1b axisColors(const cv::Mat& image, const std::vector<cv::Point2d>& stroke,
                     const StrokeRing& ring) {
  const auto within = [&](double distance) {
    return maskOf({stroke, std::max(kThinnest, 2.0 * distance)}, {{}, image.size()}, 0.0);
  };
  cv::Mat1b axis = within(ring.axis);
  if (cv::countNonZero(axis) == 0) return axis;
  cv::Mat1b around = within(ring.ring_end);
  around.setTo(0, within(ring.ring_start));
  const ColorPalette palette(image, axis, around, {kPaletteColors, kObjectShare});
  FramePixels pixels(palette, image);
  cv::Mat1b colors;
  cv::compare(pixels.entries(cv::Rect(cv::Point(), image.size())), ColorPalette::kOther, colors,
              cv::CMP_NE);
  return colors;
}

StrokeReach reachOf(const cv::Mat1b& colors, const std::vector<StrokeSample>& samples,
                    double least_share, double farthest) {
  return {reachBeside(colors, samples, 1.0, least_share, farthest),
          reachBeside(colors, samples, -1.0, least_share, farthest)};
}

}  // namespace chain_tracker
