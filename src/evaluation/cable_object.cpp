// SPDX-License-Identifier: BSD-3-Clause
/// Strands that bend anywhere and lie free: the cable and the suture.
#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "scene_object.h"
#include "scene_textures.h"
#include "strand_painting.h"

namespace chain_tracker {
namespace {

/// Points of the middle line that is painted.
constexpr int kLinePoints = 161;

struct StrandTraits {
  double length = 0.0;  ///< at scale 1 [px]
  int points = 2;       ///< material points, in equal steps
  int waves = 3;        ///< of the finest bend, in half periods along the strand
  double bend = 0.0;    ///< the most that a stretch turns away from the strand's axis [rad]
  double cycles = 1.5;  ///< how fast the bends change
  StrandLook look;
  SceneHabits habits;
};

/// Its direction along its length is a sum of waves whose strengths change smoothly, so that it
/// neither stretches nor crosses itself.
class FreeStrand : public SceneObject {
 public:
  FreeStrand(const StrandTraits& traits, cv::RNG& rng) : traits_(traits) {
    for (int i = 0; i < traits.waves; ++i)
      waves_.emplace_back(traits.cycles * (1.0 + 0.2 * i), rng);
  }

  SceneHabits habits() const override { return traits_.habits; }
  double length() const override { return traits_.length; }

  ObjectTruth truthAt(const ObjectState& state) const override {
    const std::vector<cv::Point2d> line = lineAt(state.image_from_object, state.bending_time);
    return {resampleLine(line, traits_.points),
            {},
            strandBounds(line, traits_.look, state.image_from_object.scale)};
  }

  void paint(const ObjectState& state, Layer& layer) const override {
    paintStrand(lineAt(state.image_from_object, state.bending_time), traits_.look,
                state.image_from_object.scale, layer);
  }

  /// A shorter strand of the same kind.
  void paintDecoy(const Similarity& image_from_decoy, cv::RNG& rng, Layer& layer) const override {
    std::vector<cv::Point2d> line = lineAt(image_from_decoy, rng.uniform(0.0, 20.0));
    line.resize(static_cast<size_t>(rng.uniform(kLinePoints / 3, kLinePoints * 2 / 3)));
    StrandLook look = traits_.look;
    cv::flip(look.strip, look.strip, 1);
    paintStrand(line, look, image_from_decoy.scale, layer);
  }

 private:
  std::vector<cv::Point2d> lineAt(const Similarity& image_from_object, double time) const {
    const double step = traits_.length / (kLinePoints - 1);
    std::vector<cv::Point2d> line{{0.0, 0.0}};
    cv::Point2d sum;
    for (int k = 1; k < kLinePoints; ++k) {
      const double angle = directionAt((k - 0.5) / (kLinePoints - 1), time);
      line.push_back(line.back() + step * cv::Point2d(std::cos(angle), std::sin(angle)));
      sum += line.back();
    }
    const cv::Point2d middle = sum / kLinePoints;
    for (cv::Point2d& point : line) point = image_from_object.apply(point - middle);
    return line;
  }

  double directionAt(double along, double time) const {
    double angle = 0.0;
    double total = 0.0;
    for (size_t i = 0; i < waves_.size(); ++i) {
      const double order = static_cast<double>(i + 1);
      const double weight = 1.0 / std::sqrt(order);
      angle += weight * waves_[i].at(time) * std::cos(CV_PI * order * along);
      total += weight;
    }
    return traits_.bend * angle / total;
  }

  StrandTraits traits_;
  std::vector<SmoothMotion> waves_;
};

/// A woven sleeve: short threads that cross.
void weave(cv::Mat3b& strip, int pitch, double contrast) {
  for (int y = 0; y < strip.rows; ++y) {
    for (int x = 0; x < strip.cols; ++x) {
      const double up = std::sin(2.0 * CV_PI * (x + 1.3 * y) / pitch);
      const double down = std::sin(2.0 * CV_PI * (x - 1.3 * y) / pitch);
      const double light = 1.0 + contrast * std::max(up, down);
      for (int c = 0; c < 3; ++c) strip(y, x)[c] = cv::saturate_cast<uchar>(strip(y, x)[c] * light);
    }
  }
}

/// Markings of irregular length along the strip; `share`: of the length that they cover.
void paintBands(const std::vector<cv::Scalar>& colors, double share, int shortest, int longest,
                cv::RNG& rng, cv::Mat3b& strip) {
  size_t next = 0;
  for (int x = shortest / 2; x < strip.cols;) {
    const int width = rng.uniform(shortest, longest + 1);
    const cv::Rect band = cv::Rect(x, 0, width, strip.rows) & cv::Rect(cv::Point(), strip.size());
    strip(band).setTo(colors[next++ % colors.size()]);
    x += width + cvRound(width * (1.0 - share) / share * rng.uniform(0.6, 1.4));
  }
}

}  // namespace

/// A braided cable with coloured sleeves, on a desk. 30 points evenly along it.
SceneObjectPtr makeCable(const SceneOptions& options, cv::RNG& rng) {
  StrandTraits traits;
  traits.length = 0.8 * shorterSide(options);
  traits.points = 30;
  traits.waves = 4;
  traits.bend = 2.6;
  const double half_width = 0.0155 * shorterSide(options);
  for (int i = 0; i <= 60; ++i) {
    const bool plug = i <= 2 || i >= 58;
    traits.look.half_widths.push_back(plug ? 1.3 * half_width : half_width);
  }
  const cv::Size size(cvRound(1.5 * traits.length), std::max(8, cvRound(4.0 * half_width)));
  traits.look.strip = paintMottle(size, {165.0, 95.0, 35.0}, 8.0, rng);
  if (!options.plain) {
    weave(traits.look.strip, 7, 0.25);
    paintBands({{45.0, 190.0, 235.0},
                {40.0, 40.0, 45.0},
                {215.0, 220.0, 220.0},
                {50.0, 55.0, 205.0},
                {80.0, 150.0, 60.0}},
               0.45, size.width / 45, size.width / 15, rng, traits.look.strip);
  }
  // Plugs at both ends.
  for (const int x : {0, size.width * 57 / 60}) {
    traits.look.strip.colRange(x, x + size.width * 3 / 60).setTo(cv::Scalar(52.0, 50.0, 50.0));
    traits.look.strip.colRange(x, x + size.width / 60).setTo(cv::Scalar(150.0, 152.0, 150.0));
  }
  shadeAcross(traits.look.strip, 0.25);
  traits.habits.shadow = 0.4;
  return std::make_unique<FreeStrand>(traits, rng);
}

/// A braided suture, about three pixels thick, over tissue. 40 points evenly along it.
SceneObjectPtr makeSuture(const SceneOptions& options, cv::RNG& rng) {
  StrandTraits traits;
  traits.length = 0.75 * shorterSide(options);
  traits.points = 40;
  traits.waves = 5;
  traits.bend = 2.3;
  const double half_width = 0.0034 * shorterSide(options);
  traits.look.half_widths = {half_width};
  const cv::Size size(cvRound(1.5 * traits.length), 8);
  traits.look.strip = paintMottle(size, {120.0, 45.0, 60.0}, 8.0, rng);
  if (!options.plain) {
    paintBands({{215.0, 195.0, 190.0}, {70.0, 30.0, 35.0}}, 0.4, size.width / 70, size.width / 30,
               rng, traits.look.strip);
  }
  shadeAcross(traits.look.strip, 0.3);
  traits.habits.shadow = 0.35;
  traits.habits.clutter = 1;
  return std::make_unique<FreeStrand>(traits, rng);
}

}  // namespace chain_tracker
