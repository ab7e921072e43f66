// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "chain_tracker/ros/visualization.h"

namespace chain_tracker {
namespace {

/// Coordinates are passed to OpenCV in sixteenths of a pixel.
constexpr int kFractionBits = 4;
constexpr double kFillOpacity = 0.15;
constexpr double kBorderOpacity = 0.55;
constexpr double kLabelOpacity = 0.65;
const cv::Scalar kDark(30, 30, 30);
const cv::Scalar kWhite(255, 255, 255);

/// Sizes of what is drawn, for one size of image.
struct Pen {
  explicit Pen(const cv::Size& image)
      : unit(std::max(0.6, std::hypot(image.width, image.height) / 800.0)),
        thin(std::max(1, cvRound(unit))),
        thick(std::max(2, cvRound(2.0 * unit))),
        font_scale(0.5 * unit),
        margin(std::max(2, cvRound(4.0 * unit))) {}

  double unit;  ///< 1 for an image of 640 x 480 px
  int thin;
  int thick;
  double font_scale;
  int margin;
};

cv::Scalar bgrOf(const std_msgs::ColorRGBA& color) {
  return {255.0 * color.b, 255.0 * color.g, 255.0 * color.r};
}

cv::Point fixedPoint(double x, double y) {
  const double fraction = 1 << kFractionBits;
  return {cvRound(x * fraction), cvRound(y * fraction)};
}

int fixedLength(double length) { return cvRound(length * (1 << kFractionBits)); }

std::vector<cv::Point> windowCorners(const PartPose& part) {
  const double along = 0.5 * part.size * std::cos(part.pose.theta);
  const double across = 0.5 * part.size * std::sin(part.pose.theta);
  const double x = part.pose.x;
  const double y = part.pose.y;
  return {fixedPoint(x - along + across, y - across - along),
          fixedPoint(x + along + across, y + across - along),
          fixedPoint(x + along - across, y + across + along),
          fixedPoint(x - along - across, y - across + along)};
}

/// Windows overlap: filled faintly, their borders half transparent.
void drawWindows(const TrackedObject& object, const Pen& pen, cv::Mat* canvas) {
  cv::Mat layer = canvas->clone();
  for (const PartPose& part : object.parts) {
    cv::fillConvexPoly(layer, windowCorners(part), bgrOf(colorOf(part.confidence, part.visible)),
                       cv::LINE_AA, kFractionBits);
  }
  cv::addWeighted(layer, kFillOpacity, *canvas, 1.0 - kFillOpacity, 0.0, *canvas);
  canvas->copyTo(layer);
  for (const PartPose& part : object.parts) {
    cv::polylines(layer, std::vector<std::vector<cv::Point>>{windowCorners(part)}, true,
                  bgrOf(colorOf(part.confidence, part.visible)), pen.thin, cv::LINE_AA,
                  kFractionBits);
  }
  cv::addWeighted(layer, kBorderOpacity, *canvas, 1.0 - kBorderOpacity, 0.0, *canvas);
}

void drawOutline(const TrackedObject& object, const Pen& pen, cv::Mat* canvas) {
  std::vector<cv::Point> corners;
  for (const auto& corner : object.outline.points) {
    corners.push_back(fixedPoint(corner.x, corner.y));
  }
  if (corners.empty()) return;
  const std::vector<std::vector<cv::Point>> outline{corners};
  cv::polylines(*canvas, outline, true, kDark, pen.thick + pen.thin, cv::LINE_AA, kFractionBits);
  cv::polylines(*canvas, outline, true, kWhite, pen.thin, cv::LINE_AA, kFractionBits);
}

void drawChain(const TrackedObject& object, const Pen& pen, cv::Mat* canvas) {
  const auto centre = [](const PartPose& part) { return fixedPoint(part.pose.x, part.pose.y); };
  for (const bool halo : {true, false}) {
    for (std::size_t k = 1; k < object.parts.size(); ++k) {
      cv::line(*canvas, centre(object.parts[k - 1]), centre(object.parts[k]), halo ? kDark : kWhite,
               halo ? pen.thick + pen.thin : pen.thin, cv::LINE_AA, kFractionBits);
    }
  }
  for (const PartPose& part : object.parts) {
    cv::circle(*canvas, centre(part), fixedLength(5.0 * pen.unit), kDark, cv::FILLED, cv::LINE_AA,
               kFractionBits);
    cv::circle(*canvas, centre(part), fixedLength(3.6 * pen.unit),
               bgrOf(colorOf(part.confidence, part.visible)), cv::FILLED, cv::LINE_AA,
               kFractionBits);
  }
}

void drawPoints(const TrackedObject& object, const Pen& pen, cv::Mat* canvas) {
  for (const TrackedPoint& point : object.points) {
    const cv::Point centre = fixedPoint(point.x, point.y);
    const int radius = fixedLength(6.5 * pen.unit);
    cv::circle(*canvas, centre, radius, kDark, pen.thick + pen.thin, cv::LINE_AA, kFractionBits);
    cv::circle(*canvas, centre, radius, bgrOf(colorOf(point.confidence, point.visible)), pen.thick,
               cv::LINE_AA, kFractionBits);
  }
}

std::string labelOf(const TrackedObject& object) {
  const char* const state = object.state == TrackedObject::INITIALIZING ? "INITIALIZING"
                            : object.state == TrackedObject::TRACKING   ? "TRACKING"
                            : object.state == TrackedObject::OCCLUDED   ? "OCCLUDED"
                                                                        : "LOST";
  return object.id + "  " + state + "  " + std::to_string(cvRound(100.0 * object.confidence)) +
         " %";
}

/// Writes the label at `top_left`, or as near as the image's borders allow; returns its height.
int drawLabel(const TrackedObject& object, cv::Point top_left, const Pen& pen, cv::Mat* canvas) {
  const std::string label = labelOf(object);
  int descent = 0;
  const cv::Size letters =
      cv::getTextSize(label, cv::FONT_HERSHEY_SIMPLEX, pen.font_scale, pen.thin, &descent);
  const cv::Size size(letters.width + 3 * pen.margin, letters.height + descent + 2 * pen.margin);
  top_left.x = std::max(0, std::min(top_left.x, canvas->cols - size.width));
  top_left.y = std::max(0, std::min(top_left.y, canvas->rows - size.height));
  const cv::Rect box = cv::Rect(top_left, size) & cv::Rect(cv::Point(), canvas->size());
  cv::Mat background = (*canvas)(box);
  background = background * (1.0 - kLabelOpacity) + kDark * kLabelOpacity;
  const bool lost = object.state == TrackedObject::LOST;
  const cv::Scalar color = bgrOf(colorOf(lost ? 0.0 : object.confidence, true));
  cv::rectangle(*canvas, cv::Rect(box.x, box.y, pen.margin, box.height), color, cv::FILLED);
  cv::putText(*canvas, label, {box.x + 2 * pen.margin, box.y + pen.margin + letters.height},
              cv::FONT_HERSHEY_SIMPLEX, pen.font_scale, kWhite, pen.thin, cv::LINE_AA);
  return size.height;
}

/// Above the object's region, or below it where there is no room.
cv::Point labelPlace(const TrackedObject& object, const Pen& pen) {
  const int height = cvRound(22.0 * pen.unit) + pen.margin;
  const auto top = static_cast<int>(object.roi.y_offset);
  const auto bottom = static_cast<int>(object.roi.y_offset + object.roi.height);
  return {static_cast<int>(object.roi.x_offset),
          top >= height ? top - height : bottom + pen.margin};
}

}  // namespace

cv::Mat drawOverlay(const cv::Mat& image, const TrackedObjectArray& objects) {
  cv::Mat canvas = image.clone();
  const Pen pen(image.size());
  for (const TrackedObject& object : objects.objects) {
    if (object.state == TrackedObject::LOST) continue;
    drawWindows(object, pen, &canvas);
    drawOutline(object, pen, &canvas);
    drawChain(object, pen, &canvas);
    drawPoints(object, pen, &canvas);
  }
  // Labels last, so that no object hides another one's.
  cv::Point corner(pen.margin, pen.margin);
  for (const TrackedObject& object : objects.objects) {
    if (object.state == TrackedObject::LOST) {
      corner.y += drawLabel(object, corner, pen, &canvas) + pen.margin;
    } else {
      drawLabel(object, labelPlace(object, pen), pen, &canvas);
    }
  }
  return canvas;
}

}  // namespace chain_tracker
