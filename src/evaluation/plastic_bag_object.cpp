// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "scene_object.h"
#include "scene_textures.h"

namespace chain_tracker {
namespace {

constexpr double kRadius = 0.19;  ///< in fractions of the image's shorter side
constexpr int kWaves = 6;         ///< of its outline
constexpr int kTextureSide = 320;
/// Directions in which the outline is computed; between them it is interpolated.
constexpr int kDirections = 360;
constexpr double kOpacity = 0.9;

/// Crumpled film: facets of light between sharp folds.
cv::Mat3b paintFilm(bool plain, cv::RNG& rng) {
  const cv::Size size(kTextureSide, kTextureSide);
  cv::Mat3b film(size, cv::Vec3b(212, 206, 200));
  if (!plain) {
    cv::circle(film, {150, 165}, 62, {70.0, 60.0, 200.0}, cv::FILLED, cv::LINE_AA);
    cv::circle(film, {150, 165}, 50, {212.0, 206.0, 200.0}, 5, cv::LINE_AA);
    cv::putText(film, "MARKET", {98, 176}, cv::FONT_HERSHEY_DUPLEX, 0.85, {235.0, 235.0, 240.0}, 2,
                cv::LINE_AA);
    paintPrint({95, 245, 120, 30}, 11, {70.0, 60.0, 200.0}, rng, film);
  }
  cv::Mat1f folds(size, 0.0F);
  for (int octave = 0; octave < 4; ++octave) {
    cv::Mat1f coarse(5 << octave, 5 << octave);
    rng.fill(coarse, cv::RNG::NORMAL, 0.0, 1.0);
    cv::Mat1f fine;
    cv::resize(coarse, fine, size, 0.0, 0.0, cv::INTER_CUBIC);
    folds += cv::abs(fine) / (1.0 + 1.8 * octave);
  }
  cv::Mat1f across;
  cv::Mat1f down;
  cv::Sobel(folds, across, CV_32F, 1, 0, 3);
  cv::Sobel(folds, down, CV_32F, 0, 1, 3);
  for (int row = 0; row < size.height; ++row) {
    for (int x = 0; x < size.width; ++x) {
      const double slope = 0.8 * across(row, x) + 1.0 * down(row, x);
      const double light = std::clamp(0.86 - 0.42 * slope + 0.08 * folds(row, x), 0.5, 1.22);
      for (int c = 0; c < 3; ++c)
        film(row, x)[c] = cv::saturate_cast<uchar>(film(row, x)[c] * light);
    }
  }
  cv::GaussianBlur(film, film, {0, 0}, 1.0);
  return film;
}

/// The outline at one moment: radius over direction, at scale 1 [px].
class Outline {
 public:
  explicit Outline(std::vector<double> radii) : radii_(std::move(radii)) {}

  double at(double direction) const {
    const double turn = direction / (2.0 * CV_PI);
    const double position = (turn - std::floor(turn)) * kDirections;
    const size_t before = static_cast<size_t>(position) % kDirections;
    const double share = position - std::floor(position);
    return (1.0 - share) * radii_[before] + share * radii_[(before + 1) % kDirections];
  }

  std::vector<cv::Point2d> points(const Similarity& image_from_object) const {
    std::vector<cv::Point2d> points;
    for (size_t i = 0; i < kDirections; ++i) {
      const double direction = 2.0 * CV_PI * static_cast<double>(i) / kDirections;
      points.push_back(image_from_object.apply(
          radii_[i] * cv::Point2d(std::cos(direction), std::sin(direction))));
    }
    return points;
  }

 private:
  std::vector<double> radii_;
};

class PlasticBag : public SceneObject {
 public:
  PlasticBag(const SceneOptions& options, cv::RNG& rng)
      : radius_(kRadius * shorterSide(options)), film_(paintFilm(options.plain, rng)) {
    for (int i = 0; i < kWaves; ++i) {
      cosines_.emplace_back(2.5 + 0.4 * i, rng);
      sines_.emplace_back(2.5 + 0.4 * i, rng);
    }
    for (int i = 0; i < 2; ++i) sway_.emplace_back(4.0, rng);
  }

  SceneHabits habits() const override { return {}; }
  double length() const override { return 2.0 * radius_; }

  ObjectTruth truthAt(const ObjectState& state) const override {
    const cv::Rect2d box =
        uprightBounds(outlineAt(state.bending_time).points(state.image_from_object));
    return {{box.tl(), {box.br().x, box.y}, box.br(), {box.x, box.br().y}}, {}, box};
  }

  void paint(const ObjectState& state, Layer& layer) const override {
    paintBag(state.image_from_object, state.bending_time, 1.0, layer);
  }

  void paintDecoy(const Similarity& image_from_decoy, cv::RNG& rng, Layer& layer) const override {
    paintBag(image_from_decoy, rng.uniform(0.0, 50.0), rng.uniform(0.25, 0.5), layer);
  }

 private:
  Outline outlineAt(double time) const {
    std::vector<double> radii(kDirections);
    for (size_t i = 0; i < kDirections; ++i) {
      const double direction = 2.0 * CV_PI * static_cast<double>(i) / kDirections;
      double sum = 1.0;
      for (size_t wave = 0; wave < kWaves; ++wave) {
        const double order = static_cast<double>(wave + 2);
        const double weight = 0.42 / std::pow(order, 1.1);
        sum += weight * (cosines_[wave].at(time) * std::cos(order * direction) +
                         sines_[wave].at(time) * std::sin(order * direction));
      }
      radii[i] = radius_ * std::clamp(sum, 0.45, 1.6);
    }
    return Outline(radii);
  }

  void paintBag(const Similarity& pose, double time, double size, Layer& layer) const {
    const Outline outline = outlineAt(time);
    const Similarity sized{pose.angle, pose.scale * size, pose.translation};
    const cv::Rect region = pixelsWithin(uprightBounds(outline.points(sized)), 2.0, layer);
    if (region.empty()) return;
    cv::Mat4b piece(region.size(), cv::Vec4b::all(0));
    const ObjectGrid grid(sized, region.tl());
    const cv::Point2d sway(0.12 * sway_[0].at(time), 0.12 * sway_[1].at(time));
    for (int y = 0; y < region.height; ++y) {
      for (int x = 0; x < region.width; ++x) {
        const cv::Point2d at = grid.at(x, y);
        const double distance = std::sqrt(at.dot(at));
        const double rim = outline.at(directionOf(at));
        const double covered = std::clamp((rim - distance) * sized.scale + 0.5, 0.0, 1.0);
        if (covered <= 0.0) continue;
        const double outwards = at.dot(at) / (rim * rim);
        const double light = 1.05 - 0.25 * outwards * outwards * outwards;
        piece(y, x) = coveredPixel(light * filmAt(at / rim, sway), kOpacity * covered);
      }
    }
    layer.paint(piece, region.tl());
  }

  /// `at` in the unit disc. The film slides over the bag while it deforms.
  cv::Vec3d filmAt(const cv::Point2d& at, const cv::Point2d& sway) const {
    const double middle = 0.5 * (kTextureSide - 1);
    const double weight = 1.0 - std::min(1.0, at.dot(at));
    const double x = std::clamp(middle * (1.0 + 0.95 * at.x + weight * sway.x), 0.0, 2.0 * middle);
    const double y = std::clamp(middle * (1.0 + 0.95 * at.y + weight * sway.y), 0.0, 2.0 * middle);
    const int left = std::min(static_cast<int>(x), kTextureSide - 2);
    const int top = std::min(static_cast<int>(y), kTextureSide - 2);
    const double right_share = x - left;
    const double bottom_share = y - top;
    const cv::Vec3d above = (1.0 - right_share) * cv::Vec3d(film_(top, left)) +
                            right_share * cv::Vec3d(film_(top, left + 1));
    const cv::Vec3d below = (1.0 - right_share) * cv::Vec3d(film_(top + 1, left)) +
                            right_share * cv::Vec3d(film_(top + 1, left + 1));
    return (1.0 - bottom_share) * above + bottom_share * below;
  }

  double radius_;
  cv::Mat3b film_;
  std::vector<SmoothMotion> cosines_;
  std::vector<SmoothMotion> sines_;
  std::vector<SmoothMotion> sway_;
};

}  // namespace

/// A shopping bag that the wind deforms. Its points are the corners of its upright box, from the
/// top left one clockwise: nothing on it keeps its shape.
SceneObjectPtr makePlasticBag(const SceneOptions& options, cv::RNG& rng) {
  return std::make_unique<PlasticBag>(options, rng);
}

}  // namespace chain_tracker
