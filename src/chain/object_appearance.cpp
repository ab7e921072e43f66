// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/object_appearance.h"

#include <algorithm>
#include <cmath>

namespace chain_tracker {
namespace {

/// Between the turns for which windows are learned [rad].
constexpr double kTurnStep = 0.05;
/// Samples along a pixel's side: a turned window's pixels are none of the image's.
constexpr int kSamplesPerPixel = 2;
/// Samples along a window's side, at most: more do not change the shares of colours.
constexpr int kMostSamples = 64;
/// Share of a window that lies in the first frame: of one that shows less nothing is learned.
constexpr float kLeastSeen = 0.25F;

/// Of a window's side; no less than kLeastMiddle, as the mean of a few pixels is noise [px].
constexpr double kMiddle = 0.5;
constexpr double kLeastMiddle = 8.0;

/// Points of a window of the first frame, turned back by `turn` [rad].
class TurnedWindow {
 public:
  TurnedWindow(const cv::Point2d& center, double side, double turn) {
    const int pixels = std::max(1, static_cast<int>(std::lround(side)));
    samples_ = std::min(kMostSamples, kSamplesPerPixel * pixels);
    const double spacing = static_cast<double>(pixels) / samples_;
    along_ = spacing * cv::Point2d(std::cos(turn), -std::sin(turn));
    across_ = {-along_.y, along_.x};
    first_ = center - 0.5 * (samples_ - 1) * (along_ + across_);
  }

  /// Along each side.
  int samples() const { return samples_; }
  cv::Point pixelAt(int row, int column) const { return first_ + column * along_ + row * across_; }

 private:
  int samples_ = 0;
  cv::Point2d first_;
  cv::Point2d along_;  // from one sample to the next
  cv::Point2d across_;
};

double sideOfMiddle(double side) { return std::min(side, std::max(kMiddle * side, kLeastMiddle)); }

void toRootShares(RootHistogram& counts, int all) {
  if (all == 0) return;
  for (float& count : counts) count = std::sqrt(count / static_cast<float>(all));
}

ColorPalette learnPalette(const cv::Mat& image, const Silhouette& silhouette,
                          const AppearanceModel& model) {
  const cv::Rect all(cv::Point(), image.size());
  const cv::Mat1b object = maskOf(silhouette, all, 0.0);
  const double size = std::sqrt(static_cast<double>(cv::countNonZero(object)));
  cv::Mat1b ring = maskOf(silhouette, all, std::max(2.0, model.ring * size));
  ring.setTo(0, object);
  return {image, object, ring, {model.palette_colors, model.min_object_share}};
}

}  // namespace

cv::Rect middleOfWindow(const cv::Point2d& center, double side) {
  const int pixels = std::max(1, static_cast<int>(std::lround(sideOfMiddle(side))));
  const cv::Point2d corner = center - 0.5 * (pixels - 1) * cv::Point2d(1.0, 1.0);
  return {cvRound(corner.x), cvRound(corner.y), pixels, pixels};
}

ObjectAppearance::ObjectAppearance(const cv::Mat& image, const ChainLayout& layout,
                                   const AppearanceModel& model)
    : palette_(learnPalette(image, layout.silhouette, model)), image_(image.clone()) {
  FramePixels pixels(palette_, image);
  learnFrame(image.size(), pixels);
  for (const SegmentLayout& segment : layout.segments) {
    for (const PartLayout& part : segment.parts) {
      windows_.push_back({segment.image_from_segment.apply(part.position), part.side});
    }
  }
  learnReach(layout.silhouette);
  for (size_t k = 0; k < windows_.size(); ++k) parts_[{k, 0}] = learnUpright(windows_[k], pixels);
}

void ObjectAppearance::learnFrame(const cv::Size& size, FramePixels& pixels) {
  const cv::Rect all(cv::Point(), size);
  entries_ = pixels.entries(all).clone();
  grey_ = pixels.grey(all).clone();
  EdgeDirections directions;
  for (const cv::Mat1i& gradient :
       directions.gradients(pixels.grey(EdgeDirections::neededFor(all)))) {
    gradients_.push_back(gradient.clone());
  }
}

void ObjectAppearance::learnReach(const Silhouette& silhouette) {
  reach_ = cv::Rect(cv::Point(), entries_.size());
  for (const Window& window : windows_) {
    const double half = std::sqrt(0.5) * window.side + 1.0;
    const cv::Point2d corner(half, half);
    reach_ |= cv::Rect(cv::Point(window.center - corner), cv::Point(window.center + corner));
  }
  object_ = maskOf(silhouette, reach_, 0.0);
}

/// Beyond the image, what is not of the object is background.
bool ObjectAppearance::isKnown(const cv::Point& pixel) const {
  return cv::Rect(cv::Point(), entries_.size()).contains(pixel) ||
         object_(pixel - reach_.tl()) == 0;
}

/// As learnTurned(), but with histograms of the very windows that are searched.
PartAppearance ObjectAppearance::learnUpright(const Window& window, FramePixels& pixels) const {
  PartAppearance appearance = learnTurned(window, 0.0);
  if (appearance.known < 1.0F) return appearance;
  appearance.colors = learnPart(pixels, Channel::kColors, window.center, window.side);
  appearance.edges = learnPart(pixels, Channel::kEdges, window.center, window.side);
  return appearance;
}

const PartAppearance& ObjectAppearance::part(size_t index, double turn) {
  const int steps = static_cast<int>(std::lround(turn / kTurnStep));
  const auto known = parts_.find({index, steps});
  if (known != parts_.end()) return known->second;
  return parts_[{index, steps}] = learnTurned(windows_[index], steps * kTurnStep);
}

PartAppearance ObjectAppearance::learnTurned(const Window& window, double turn) const {
  const TurnedWindow turned(window.center, window.side, turn);
  const int samples = turned.samples();
  const cv::Point2f rotation(static_cast<float>(std::cos(turn)),
                             static_cast<float>(std::sin(turn)));
  const cv::Rect image(cv::Point(), entries_.size());
  RootHistogram colors(static_cast<size_t>(palette_.size()), 0.0F);
  RootHistogram edges(kEdgeCodes, 0.0F);
  int seen = 0;
  int known = 0;
  int quadrants[2][2] = {{0, 0}, {0, 0}};
  for (int row = 0; row < samples; ++row) {
    for (int column = 0; column < samples; ++column) {
      const cv::Point pixel = turned.pixelAt(row, column);
      const bool is_inside = image.contains(pixel);
      if (is_inside) ++seen;
      if (isKnown(pixel)) {
        ++known;
        ++colors[is_inside ? entries_(pixel) : ColorPalette::kOther];
        ++edges[static_cast<size_t>(is_inside ? turnedEdge(pixel, rotation) : kNoEdge)];
      }
      const cv::Point nearest(std::clamp(pixel.x, 0, image.width - 1),
                              std::clamp(pixel.y, 0, image.height - 1));
      quadrants[2 * row / samples][2 * column / samples] += grey_(nearest);
    }
  }
  toRootShares(colors, known);
  toRootShares(edges, known);
  const auto all = static_cast<float>(samples * samples);
  const auto mean = [&](int row, int column) {
    return 4.0F * static_cast<float>(quadrants[row][column]) / all;
  };
  const bool is_seen = static_cast<float>(seen) >= kLeastSeen * all;
  return {colors, edges, textureOf(mean(0, 0), mean(0, 1), mean(1, 0), mean(1, 1)),
          is_seen ? static_cast<float>(known) / all : 0.0F, learnMiddle(window, turn)};
}

ObjectColor ObjectAppearance::learnMiddle(const Window& window, double turn) const {
  const TurnedWindow middle(window.center, sideOfMiddle(window.side), turn);
  const cv::Rect image(cv::Point(), entries_.size());
  int own = 0;
  cv::Vec3d sum;
  for (int row = 0; row < middle.samples(); ++row) {
    for (int column = 0; column < middle.samples(); ++column) {
      const cv::Point pixel = middle.pixelAt(row, column);
      if (!image.contains(pixel) || entries_(pixel) == ColorPalette::kOther) continue;
      sum += image_.channels() == 3 ? cv::Vec3d(image_.at<cv::Vec3b>(pixel))
                                    : cv::Vec3d::all(grey_(pixel));
      ++own;
    }
  }
  const double all = static_cast<double>(middle.samples()) * middle.samples();
  return {own / all, sum / std::max(1, own)};
}

/// Code of a pixel's edge after a turn.
int ObjectAppearance::turnedEdge(const cv::Point& pixel, const cv::Point2f& rotation) const {
  const auto right = static_cast<float>(gradients_[0](pixel));
  const auto down = static_cast<float>(gradients_[1](pixel));
  return edgeCode(rotation.x * right - rotation.y * down, rotation.y * right + rotation.x * down);
}

}  // namespace chain_tracker
