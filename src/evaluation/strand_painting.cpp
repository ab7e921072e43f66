// SPDX-License-Identifier: BSD-3-Clause
#include "strand_painting.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "chain_tracker/image/pixel_geometry.h"

namespace chain_tracker {
namespace {

/// Where a pixel lies on the strand; the nearest stretch of the middle line decides.
struct Footing {
  float distance = std::numeric_limits<float>::infinity();  ///< from the middle line [px]
  float side = 0.0F;                                        ///< the same, signed
  float along = 0.0F;  ///< from 0 at the first to 1 at the last point
};

double sampled(const std::vector<double>& values, double along) {
  const double position = along * static_cast<double>(values.size() - 1);
  const size_t before = std::min(static_cast<size_t>(position), values.size() - 1);
  const size_t after = std::min(before + 1, values.size() - 1);
  return values[before] +
         (position - static_cast<double>(before)) * (values[after] - values[before]);
}

cv::Vec3d sampled(const cv::Mat3b& strip, double along, double across) {
  const double x = std::clamp(along, 0.0, 1.0) * (strip.cols - 1);
  const double y = std::clamp(0.5 + 0.5 * across, 0.0, 1.0) * (strip.rows - 1);
  const int left = std::min(static_cast<int>(x), std::max(strip.cols - 2, 0));
  const int right = std::min(left + 1, strip.cols - 1);
  const int row = cvRound(y);
  const double share = x - left;
  return cv::Vec3d(strip(row, left)) * (1.0 - share) + cv::Vec3d(strip(row, right)) * share;
}

/// The footing of all pixels near one stretch of the line.
class StretchWalk {
 public:
  StretchWalk(const std::vector<cv::Point2d>& line, size_t index)
      : from_(line[index]),
        length_(std::max(cv::norm(line[index + 1] - from_), 1e-9)),
        direction_((line[index + 1] - from_) / length_),
        index_(static_cast<double>(index)),
        stretches_(static_cast<double>(line.size() - 1)) {}

  void update(const cv::Point2d& pixel, Footing& footing) const {
    const cv::Point2d offset = pixel - from_;
    const double t = offset.dot(direction_);
    const double inside = std::clamp(t, 0.0, length_);
    const double side = direction_.cross(offset);
    const double beyond = t - inside;
    const float distance = static_cast<float>(std::sqrt(side * side + beyond * beyond));
    if (distance >= footing.distance) return;
    footing = {distance, static_cast<float>(std::copysign(distance, side)),
               static_cast<float>((index_ + inside / length_) / stretches_)};
  }

 private:
  cv::Point2d from_;
  double length_;
  cv::Point2d direction_;
  double index_;
  double stretches_;
};

/// The straight cuts at both ends.
class StrandEnds {
 public:
  /// `reach`: how far from an end a pixel may be that its cut concerns [px].
  StrandEnds(const std::vector<cv::Point2d>& line, double reach)
      : first_(line.front()),
        last_(line.back()),
        first_outwards_(unit(line[0] - line[1])),
        last_outwards_(unit(line.back() - line[line.size() - 2])),
        concerned_(reach / std::max(lengthOf(line), 1e-9)) {}

  /// The share of a pixel that the cuts leave.
  double coverageAt(const cv::Point2d& pixel, const Footing& footing) const {
    double overshoot = -1.0;
    if (footing.along < concerned_) {
      overshoot = std::max(overshoot, first_outwards_.dot(pixel - first_));
    }
    if (footing.along > 1.0 - concerned_) {
      overshoot = std::max(overshoot, last_outwards_.dot(pixel - last_));
    }
    return std::clamp(0.5 - overshoot, 0.0, 1.0);
  }

 private:
  static cv::Point2d unit(const cv::Point2d& vector) {
    return vector / std::max(cv::norm(vector), 1e-9);
  }

  cv::Point2d first_;
  cv::Point2d last_;
  cv::Point2d first_outwards_;
  cv::Point2d last_outwards_;
  double concerned_;
};

double coverageAcross(const Footing& footing, double half_width) {
  // A strand thinner than a pixel covers a part of it only.
  return std::clamp(half_width + 0.5 - footing.distance, 0.0, std::min(1.0, 2.0 * half_width));
}

double widest(const StrandLook& look) {
  return *std::max_element(look.half_widths.begin(), look.half_widths.end());
}

}  // namespace

void paintStrand(const std::vector<cv::Point2d>& line, const StrandLook& look, double scale,
                 Layer& layer) {
  const double margin = widest(look) * scale + 1.0;
  const cv::Rect region = pixelsWithin(uprightBounds(line), margin, layer);
  if (region.empty()) return;
  std::vector<Footing> footings(static_cast<size_t>(region.area()));
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const StretchWalk stretch(line, i);
    const cv::Rect near = pixelsWithin(uprightBounds({line[i], line[i + 1]}), margin, layer);
    for (int y = near.y; y < near.br().y; ++y) {
      Footing* row =
          footings.data() + static_cast<size_t>(y - region.y) * static_cast<size_t>(region.width);
      for (int x = near.x; x < near.br().x; ++x) {
        stretch.update(cv::Point2d(x, y), row[x - region.x]);
      }
    }
  }
  const StrandEnds ends(line, margin);
  cv::Mat4b piece(region.size(), cv::Vec4b::all(0));
  for (int y = 0; y < region.height; ++y) {
    for (int x = 0; x < region.width; ++x) {
      const Footing& footing = footings[static_cast<size_t>(y) * static_cast<size_t>(region.width) +
                                        static_cast<size_t>(x)];
      if (footing.distance > margin) continue;
      const double half_width = scale * sampled(look.half_widths, footing.along);
      const cv::Point2d pixel(region.x + x, region.y + y);
      const double covered = coverageAcross(footing, half_width) * ends.coverageAt(pixel, footing);
      if (covered <= 0.0) continue;
      const double across = footing.side / std::max(half_width, 0.5);
      piece(y, x) = coveredPixel(sampled(look.strip, footing.along, across), covered);
    }
  }
  layer.paint(piece, region.tl());
}

cv::Rect2d strandBounds(const std::vector<cv::Point2d>& line, const StrandLook& look,
                        double scale) {
  std::vector<cv::Point2d> rims;
  for (size_t i = 0; i < line.size(); ++i) {
    const cv::Point2d along = line[std::min(i + 1, line.size() - 1)] - line[i == 0 ? 0 : i - 1];
    const cv::Point2d across = cv::Point2d(-along.y, along.x) / std::max(cv::norm(along), 1e-9);
    const double share = static_cast<double>(i) / static_cast<double>(line.size() - 1);
    const double half_width = scale * sampled(look.half_widths, share);
    rims.push_back(line[i] + half_width * across);
    rims.push_back(line[i] - half_width * across);
  }
  return uprightBounds(rims);
}

std::vector<cv::Point2d> resampleLine(const std::vector<cv::Point2d>& line, int count) {
  std::vector<cv::Point2d> points;
  for (int k = 0; k < count; ++k) {
    const double position = k * static_cast<double>(line.size() - 1) / (count - 1);
    const size_t before = std::min(static_cast<size_t>(position), line.size() - 2);
    points.push_back(line[before] +
                     (position - static_cast<double>(before)) * (line[before + 1] - line[before]));
  }
  return points;
}

void shadeAcross(cv::Mat3b& strip, double gloss) {
  for (int row = 0; row < strip.rows; ++row) {
    const double across = 2.0 * (row + 0.5) / strip.rows - 1.0;
    const double light = 1.1 * std::sqrt(1.0 - 0.75 * across * across);
    const double shine = 255.0 * gloss * std::exp(-std::pow((across + 0.4) / 0.22, 2.0));
    for (int x = 0; x < strip.cols; ++x) {
      for (int c = 0; c < 3; ++c) {
        strip(row, x)[c] = cv::saturate_cast<uchar>(strip(row, x)[c] * light + shine);
      }
    }
  }
}

}  // namespace chain_tracker
