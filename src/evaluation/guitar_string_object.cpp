// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "scene_object.h"
#include "scene_textures.h"
#include "strand_painting.h"

namespace chain_tracker {
namespace {

constexpr int kPoints = 30;
constexpr int kLinePoints = 121;
/// Lengths below are in fractions of the string's.
constexpr double kHalfThickness = 0.0042;
constexpr double kSpacing = 0.04;
constexpr double kAmplitude = 0.028;
/// Vibration as a camera sees it, slowed down by its frame rate [cycles/frame].
constexpr double kFrequency = 0.09;
constexpr double kFramesPerPluck = 75.0;
/// The place of the string among the six, and the order in which others join it.
constexpr int kOthers[5] = {-1, 1, -2, 2, 3};
constexpr double kSpritePixels = 1.0;

/// Wound with wire: fine turns, worn in places.
StrandLook paintString(double length, bool plain, const cv::Scalar& metal, double half_width,
                       cv::RNG& rng) {
  StrandLook look;
  look.half_widths = {half_width};
  look.strip = paintMottle({cvRound(2.0 * length), 8}, metal, plain ? 3.0 : 16.0, rng);
  if (!plain) {
    for (int x = 0; x < look.strip.cols; ++x) {
      look.strip.col(x) *= 0.95 + 0.12 * std::sin(2.0 * CV_PI * x / 8.0);
    }
    for (int patch = 0; patch < 14; ++patch) {
      const int from = rng.uniform(0, look.strip.cols - 40);
      look.strip.colRange(from, from + rng.uniform(12, 40)) *= rng.uniform(0.45, 0.7);
    }
  }
  shadeAcross(look.strip, 0.35);
  return look;
}

/// Frets, inlays and the nut on the neck, which ends at column `body`.
void paintNeck(const cv::Rect& neck, int nut, double length, cv::RNG& rng, cv::Mat3b& color) {
  paintWood(neck.size(), {38.0, 52.0, 78.0}, 11.0, rng).copyTo(color(neck));
  const auto fret = [&](int n) { return nut + cvRound(length * (1.0 - std::pow(2.0, -n / 12.0))); };
  for (int n = 1; fret(n) < neck.br().x; ++n) {
    const int x = fret(n);
    cv::rectangle(color, cv::Rect(x + 3, neck.y, 2, neck.height), {20.0, 28.0, 42.0}, cv::FILLED);
    cv::rectangle(color, cv::Rect(x, neck.y, 3, neck.height), {175.0, 182.0, 188.0}, cv::FILLED);
    const bool marked = n == 3 || n == 5 || n == 7 || n == 9;
    if (marked || n == 12) {
      const cv::Point middle((fret(n - 1) + x) / 2, neck.y + neck.height / 2);
      const int off = n == 12 ? neck.height / 4 : 0;
      for (const int y : {-off, off}) {
        cv::circle(color, middle + cv::Point(0, y), std::max(2, neck.height / 16),
                   {205.0, 215.0, 218.0}, cv::FILLED, cv::LINE_AA);
      }
    }
  }
  cv::rectangle(color, cv::Rect(nut - 8, neck.y, 8, neck.height), {190.0, 215.0, 225.0},
                cv::FILLED);
}

/// The guitar around the strings, which lie along +x around the sprite's centre.
Sprite paintGuitar(double length, cv::RNG& rng) {
  const cv::Size size(cvRound(1.9 * length), cvRound(1.1 * length));
  const cv::Point2d center(0.5 * (size.width - 1), 0.5 * (size.height - 1));
  const int nut = cvRound(center.x - 0.5 * length);
  const int bridge = cvRound(center.x + 0.5 * length);
  const int neck_half = cvRound(3.4 * kSpacing * length);
  const int middle = cvRound(center.y + 0.5 * kSpacing * length);
  const cv::Point hole(cvRound(center.x + 0.17 * length), middle);
  const int hole_radius = cvRound(0.125 * length);
  const cv::Point belly(cvRound(center.x + 0.5 * length), middle);
  const cv::Size belly_half(cvRound(0.52 * length), cvRound(0.5 * length));

  cv::Mat3b color = paintWood(size, {95.0, 150.0, 195.0}, 9.0, rng);
  cv::Mat1b coverage(size, uchar(0));
  cv::ellipse(coverage, belly, belly_half, 0.0, 0.0, 360.0, 255, cv::FILLED, cv::LINE_AA);
  cv::ellipse(color, belly, belly_half - cv::Size(5, 5), 0.0, 0.0, 360.0, {45.0, 60.0, 80.0}, 7,
              cv::LINE_AA);
  cv::ellipse(color, belly, belly_half - cv::Size(9, 9), 0.0, 0.0, 360.0, {200.0, 215.0, 225.0}, 2,
              cv::LINE_AA);
  cv::circle(color, hole, hole_radius, {28.0, 30.0, 36.0}, cv::FILLED, cv::LINE_AA);
  for (const int ring : {6, 10, 16, 19}) {
    cv::circle(color, hole, hole_radius + ring, {40.0, 62.0, 92.0}, ring == 10 ? 4 : 1,
               cv::LINE_AA);
  }
  cv::rectangle(color, cv::Rect(bridge - 3, middle - neck_half * 9 / 8, 26, neck_half * 9 / 4),
                {32.0, 40.0, 58.0}, cv::FILLED);
  cv::rectangle(color, cv::Rect(bridge, middle - neck_half, 5, 2 * neck_half),
                {200.0, 222.0, 230.0}, cv::FILLED);
  const cv::Rect neck(nut - cvRound(0.16 * length), middle - neck_half,
                      hole.x - hole_radius - 8 - nut + cvRound(0.16 * length), 2 * neck_half);
  paintNeck(neck & cv::Rect(cv::Point(), size), nut, length, rng, color);
  coverage(neck & cv::Rect(cv::Point(), size)).setTo(255);
  addGrain(3.0, 0.8, rng, color);
  shadeUnevenly(0.4, rng, color);
  return {color, coverage, center, kSpritePixels};
}

class GuitarString : public SceneObject {
 public:
  GuitarString(const SceneOptions& options, cv::RNG& rng)
      : length_(0.68 * options.size.width),
        others_(std::clamp(options.clutter.value_or(5), 0, 5)),
        guitar_(paintGuitar(length_, rng)),
        look_(paintString(length_, options.plain, {105.0, 165.0, 215.0}, kHalfThickness * length_,
                          rng)),
        other_look_(paintString(length_, options.plain, {110.0, 160.0, 200.0},
                                0.85 * kHalfThickness * length_, rng)) {
    for (double& phase : phases_) phase = rng.uniform(0.0, 2.0 * CV_PI);
  }

  SceneHabits habits() const override {
    SceneHabits habits;
    habits.motion = {{0.5, 0.5}, {0.05, 0.12}, 0.0, 0.2};
    habits.blur = 0.5;
    habits.clutter = 0;
    habits.shadow = 0.35;
    return habits;
  }
  double length() const override { return length_; }

  ObjectTruth truthAt(const ObjectState& state) const override {
    const std::vector<cv::Point2d> line = lineAt(state);
    return {
        resampleLine(line, kPoints), {}, strandBounds(line, look_, state.image_from_object.scale)};
  }

  void paint(const ObjectState& state, Layer& layer) const override {
    paintStrand(lineAt(state), look_, state.image_from_object.scale, layer);
  }

  void paintCompanions(const ObjectState& state, Layer& layer) const override {
    const Similarity& pose = state.image_from_object;
    guitar_.paint(pose, layer);
    for (int i = 0; i < others_; ++i) {
      const double y = kSpacing * length_ * kOthers[i];
      paintStrand(
          resampleLine({pose.apply({-0.5 * length_, y}), pose.apply({0.5 * length_, y})}, 9),
          other_look_, pose.scale * (1.0 - 0.12 * kOthers[i]), layer);
    }
  }

  /// Its clutter are the strings beside it.
  void paintDecoy(const Similarity& /*image_from_decoy*/, cv::RNG& /*rng*/,
                  Layer& /*layer*/) const override {}

 private:
  std::vector<cv::Point2d> lineAt(const ObjectState& state) const {
    const double frames = state.bending_time * kFramesPerTime;
    // Plucked again and again: a fast attack, then it dies away.
    const double since = frames - kFramesPerPluck * std::floor(frames / kFramesPerPluck);
    const double strength = std::min(1.0, since / 5.0) * std::exp(-1.8 * since / kFramesPerPluck) *
                            std::clamp((kFramesPerPluck - since) / 10.0, 0.0, 1.0);
    std::vector<cv::Point2d> line;
    for (int k = 0; k < kLinePoints; ++k) {
      const double along = k / (kLinePoints - 1.0);
      double y = 0.0;
      for (int mode = 1; mode <= 3; ++mode) {
        y += std::sin(CV_PI * mode * along) / (mode * mode) *
             std::sin(2.0 * CV_PI * kFrequency * mode * frames + phases_[mode - 1]);
      }
      line.push_back(state.image_from_object.apply(
          {length_ * (along - 0.5), kAmplitude * length_ * strength * y}));
    }
    return line;
  }

  double length_;
  int others_;
  Sprite guitar_;
  StrandLook look_;
  StrandLook other_look_;
  double phases_[3];
};

}  // namespace

/// A plucked string among others. 30 points evenly along it, nut first.
SceneObjectPtr makeGuitarString(const SceneOptions& options, cv::RNG& rng) {
  return std::make_unique<GuitarString>(options, rng);
}

}  // namespace chain_tracker
