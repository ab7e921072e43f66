// SPDX-License-Identifier: BSD-3-Clause
#include "scene_painting.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace chain_tracker {
namespace {

/// Sprites are kept in this many resolutions, so that they shrink without aliasing.
constexpr int kLevels = 3;
/// Shadows are soft: they are computed this much coarser.
constexpr int kShadowStep = 4;

uchar overBytes(uchar above, uchar below, int transparency) {
  return static_cast<uchar>(std::min(255, above + (below * transparency + 127) / 255));
}

cv::Mat4b withCoverage(const cv::Mat3b& color, const cv::Mat1b& coverage) {
  cv::Mat4b covered(color.size());
  for (int row = 0; row < color.rows; ++row) {
    for (int x = 0; x < color.cols; ++x) {
      covered(row, x) = coveredPixel(color(row, x), coverage(row, x) / 255.0);
    }
  }
  return covered;
}

}  // namespace

void Layer::paint(const cv::Mat4b& piece, const cv::Point& top_left) {
  const cv::Rect area = cv::Rect(top_left, piece.size()) & bounds();
  if (area.empty()) return;
  touched_ = touched_.empty() ? area : touched_ | area;
  for (int row = area.y; row < area.br().y; ++row) {
    const cv::Vec4b* above = piece[row - top_left.y] + (area.x - top_left.x);
    cv::Vec4b* below = pixels_[row] + area.x;
    for (int x = 0; x < area.width; ++x) {
      const int transparency = 255 - above[x][3];
      if (transparency == 255) continue;
      if (transparency == 0) {
        below[x] = above[x];
        continue;
      }
      for (int c = 0; c < 4; ++c) below[x][c] = overBytes(above[x][c], below[x][c], transparency);
    }
  }
}

void Layer::composite(cv::Mat3b& canvas) const {
  for (int row = touched_.y; row < touched_.br().y; ++row) {
    const cv::Vec4b* above = pixels_[row];
    cv::Vec3b* below = canvas[row];
    for (int x = touched_.x; x < touched_.br().x; ++x) {
      const int transparency = 255 - above[x][3];
      if (transparency == 255) continue;
      for (int c = 0; c < 3; ++c) below[x][c] = overBytes(above[x][c], below[x][c], transparency);
    }
  }
}

void Layer::castShadow(double strength, cv::Mat3b& canvas) const {
  if (strength <= 0.0 || touched_.empty()) return;
  const int reach = std::max(4, pixels_.rows / 60);
  const cv::Rect area = cv::Rect(touched_.tl() - cv::Point(2 * reach, 2 * reach),
                                 touched_.size() + cv::Size(5 * reach, 5 * reach)) &
                        bounds();
  cv::Mat1b coverage;
  cv::extractChannel(pixels_(area), coverage, 3);
  cv::Mat1b coarse;
  cv::resize(coverage, coarse, {1 + area.width / kShadowStep, 1 + area.height / kShadowStep}, 0.0,
             0.0, cv::INTER_AREA);
  const double shift = 0.7 * reach / kShadowStep;
  const cv::Matx23d moved(1.0, 0.0, shift, 0.0, 1.0, 1.3 * shift);
  cv::warpAffine(coarse, coarse, moved, coarse.size(), cv::INTER_LINEAR);
  cv::GaussianBlur(coarse, coarse, {0, 0}, 0.6 * reach / kShadowStep, 0.0, cv::BORDER_REPLICATE);
  cv::resize(coarse, coverage, area.size(), 0.0, 0.0, cv::INTER_LINEAR);
  const int weight = cvRound(257.0 * strength);  // of 65536, with a coverage of 255
  for (int row = 0; row < area.height; ++row) {
    cv::Vec3b* pixel = canvas[area.y + row] + area.x;
    for (int x = 0; x < area.width; ++x) {
      const int light = 65536 - weight * coverage(row, x);
      for (int c = 0; c < 3; ++c) pixel[x][c] = static_cast<uchar>((pixel[x][c] * light) >> 16);
    }
  }
}

int Layer::coverageAt(const cv::Point2d& point) const {
  const cv::Point pixel(cvRound(point.x), cvRound(point.y));
  return bounds().contains(pixel) ? pixels_(pixel)[3] : 0;
}

cv::Vec4b coveredPixel(const cv::Vec3d& color, double coverage) {
  return {cv::saturate_cast<uchar>(coverage * std::min(color[0], 255.0)),
          cv::saturate_cast<uchar>(coverage * std::min(color[1], 255.0)),
          cv::saturate_cast<uchar>(coverage * std::min(color[2], 255.0)),
          cv::saturate_cast<uchar>(coverage * 255.0)};
}

cv::Rect pixelsWithin(const cv::Rect2d& bounds, double margin, const Layer& layer) {
  // Cut first: far outside, the numbers need not fit an int.
  const cv::Rect2d cut = cv::Rect2d(bounds.x - margin, bounds.y - margin,
                                    bounds.width + 2.0 * margin, bounds.height + 2.0 * margin) &
                         cv::Rect2d(layer.bounds());
  if (cut.empty()) return {};
  const cv::Point low(cvFloor(cut.x), cvFloor(cut.y));
  const cv::Point high(cvCeil(cut.br().x) + 1, cvCeil(cut.br().y) + 1);
  return cv::Rect(low, high) & layer.bounds();
}

ObjectGrid::ObjectGrid(const Similarity& image_from_object, const cv::Point& first_pixel)
    : origin_(image_from_object.applyInverse(first_pixel)),
      right_(image_from_object.applyInverse(first_pixel + cv::Point(1, 0)) - origin_),
      down_(image_from_object.applyInverse(first_pixel + cv::Point(0, 1)) - origin_) {}

Sprite::Sprite(const cv::Mat3b& color, const cv::Mat1b& coverage, const cv::Point2d& center,
               double pixels)
    : Sprite(withCoverage(color, coverage), center, pixels) {}

Sprite::Sprite(const cv::Mat4b& covered, const cv::Point2d& center, double pixels)
    : center_(center), pixels_(pixels) {
  // Halving must not change the scale: the sides become multiples of the coarsest level's pixel.
  constexpr int kMultiple = 1 << (kLevels - 1);
  const auto missing = [](int side) { return (kMultiple - side % kMultiple) % kMultiple; };
  cv::Mat4b level;
  cv::copyMakeBorder(covered, level, 0, missing(covered.rows), 0, missing(covered.cols),
                     cv::BORDER_CONSTANT, cv::Scalar::all(0.0));
  levels_.push_back(level);
  while (levels_.size() < kLevels) {
    cv::Mat4b halved;
    cv::resize(levels_.back(), halved, levels_.back().size() / 2, 0.0, 0.0, cv::INTER_AREA);
    levels_.push_back(halved);
  }
}

void Sprite::paint(const Similarity& image_from_object, Layer& layer) const {
  const cv::Mat4b& finest = levels_.front();
  const auto corner = [&](int x, int y) {
    return image_from_object.apply((cv::Point2d(x, y) - center_) / pixels_);
  };
  const cv::Rect region =
      pixelsWithin(uprightBounds({corner(0, 0), corner(finest.cols, 0), corner(0, finest.rows),
                                  corner(finest.cols, finest.rows)}),
                   1.0, layer);
  if (region.empty()) return;
  const double fineness = pixels_ / image_from_object.scale;
  const int index = std::clamp(cvRound(std::log2(fineness)), 0, kLevels - 1);
  // Pixel centres of a halved picture: x = x_fine / 2 - 1 / 4, and so on.
  const double shrink = 1 << index;
  const cv::Point2d center = (center_ + cv::Point2d(0.5, 0.5)) / shrink - cv::Point2d(0.5, 0.5);
  const double scale = image_from_object.scale * shrink / pixels_;
  const double c = scale * std::cos(image_from_object.angle);
  const double s = scale * std::sin(image_from_object.angle);
  const cv::Point2d origin = image_from_object.translation - cv::Point2d(region.tl());
  const cv::Matx23d region_from_level(c, -s, origin.x - c * center.x + s * center.y, s, c,
                                      origin.y - s * center.x - c * center.y);
  cv::Mat4b piece;
  cv::warpAffine(levels_[static_cast<size_t>(index)], piece, region_from_level, region.size(),
                 cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar::all(0.0));
  layer.paint(piece, region.tl());
}

Sprite Sprite::piece(double size, cv::RNG& rng) const {
  const cv::Mat4b& finest = levels_.front();
  const cv::Size cut(std::max(1, cvRound(size * finest.cols)),
                     std::max(1, cvRound(size * finest.rows)));
  const cv::Size room = finest.size() - cut;
  const cv::Point corner(cvRound(room.width * rng.uniform(0.3, 0.7)),
                         cvRound(room.height * rng.uniform(0.3, 0.7)));
  cv::Mat4b covered;
  cv::copyMakeBorder(finest(cv::Rect(corner, cut)), covered, 4, 4, 4, 4, cv::BORDER_CONSTANT,
                     cv::Scalar::all(0.0));
  return {covered, cv::Point2d(0.5 * cut.width + 4.0, 0.5 * cut.height + 4.0), pixels_};
}

}  // namespace chain_tracker
