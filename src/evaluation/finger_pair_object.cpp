// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "scene_object.h"
#include "scene_textures.h"
#include "strand_painting.h"

namespace chain_tracker {
namespace {

/// Of a finger, in fractions of the image's shorter side.
constexpr double kDistal = 0.155;
constexpr double kProximal = 0.17;
constexpr double kHalfWidth = 0.038;
/// Directions of the fingers at rest, and how far they swing, at the usual rate of turning.
constexpr double kSpread[2] = {-0.42, 0.38};
constexpr double kSwing = 0.35;
constexpr double kBend = 0.75;
constexpr int kLinePoints = 22;
constexpr int kStripRows = 64;

const cv::Scalar kSkin(138.0, 165.0, 214.0);

/// Light from above the hand, soft: skin does not shine.
void shadeSkin(cv::Mat3b& strip) {
  for (int row = 0; row < strip.rows; ++row) {
    const double across = 2.0 * (row + 0.5) / strip.rows - 1.0;
    const double light = 1.06 - 0.1 * across - 0.42 * std::pow(std::abs(across), 3.0);
    for (int x = 0; x < strip.cols; ++x) {
      cv::Vec3b& pixel = strip(row, x);
      // Shadows on skin are redder than skin.
      pixel[0] = cv::saturate_cast<uchar>(pixel[0] * std::pow(light, 1.25));
      pixel[1] = cv::saturate_cast<uchar>(pixel[1] * std::pow(light, 1.1));
      pixel[2] = cv::saturate_cast<uchar>(pixel[2] * light);
    }
  }
}

void paintCreases(int x, int spacing, cv::Mat3b& strip, cv::RNG& rng) {
  cv::Mat1b crease(strip.size(), uchar(0));
  for (int i = -1; i <= 1; ++i) {
    const int at = x + i * spacing;
    cv::ellipse(crease, {at + 3 * spacing * i, strip.rows / 2},
                {std::max(2, 3 * spacing * std::abs(i)), strip.rows * 2 / 5}, 0.0, 0.0, 360.0,
                rng.uniform(60.0, 120.0), 1, cv::LINE_AA);
  }
  cv::GaussianBlur(crease, crease, {0, 0}, 1.2);
  tint(crease, {75.0, 95.0, 150.0}, strip);
  cv::Mat1b blush(strip.size(), uchar(0));
  cv::ellipse(blush, {x, strip.rows / 2}, {6 * spacing, strip.rows / 2}, 0.0, 0.0, 360.0, 70,
              cv::FILLED);
  cv::GaussianBlur(blush, blush, {0, 0}, 6.0);
  tint(blush, {115.0, 125.0, 205.0}, strip);
}

/// A nail with its light moon and a glint; the strip begins at the finger's tip.
void paintNail(int length, cv::Mat3b& strip) {
  const cv::Point middle(length * 7 / 12, strip.rows / 2);
  const cv::Size half(length / 2, strip.rows * 27 / 100);
  cv::Mat1b rim(strip.size(), uchar(0));
  cv::ellipse(rim, middle, half + cv::Size(2, 4), 0.0, 0.0, 360.0, 150, cv::FILLED, cv::LINE_AA);
  cv::GaussianBlur(rim, rim, {0, 0}, 1.5);
  tint(rim, {85.0, 105.0, 165.0}, strip);
  cv::Mat1b nail(strip.size(), uchar(0));
  cv::ellipse(nail, middle, half, 0.0, 0.0, 360.0, 235, cv::FILLED, cv::LINE_AA);
  tint(nail, {165.0, 175.0, 225.0}, strip);
  cv::Mat1b glint(strip.size(), uchar(0));
  cv::ellipse(glint, middle - cv::Point(0, half.height / 3), {half.width * 2 / 3, 3}, 0.0, 0.0,
              360.0, 160, cv::FILLED, cv::LINE_AA);
  cv::GaussianBlur(glint, glint, {0, 0}, 1.5);
  tint(glint, {240.0, 240.0, 250.0}, strip);
}

/// From the tip to the root, for a finger `length` px long.
StrandLook paintFinger(double length, double half_width, cv::RNG& rng) {
  StrandLook look;
  const int columns = cvRound(1.5 * length);
  look.strip = paintMottle({columns, kStripRows}, kSkin, 7.0, rng);
  addGrain(5.0, 1.2, rng, look.strip);
  const int knuckle = cvRound(columns * kDistal / (kDistal + kProximal));
  paintCreases(knuckle, 5, look.strip, rng);
  paintCreases(knuckle * 11 / 20, 3, look.strip, rng);
  shadeSkin(look.strip);
  paintNail(columns * 15 / 100, look.strip);
  // A round tip, a slight taper, wider joints.
  for (int i = 0; i < 121; ++i) {
    const double along = i / 120.0;
    const double tip = std::min(1.0, along * length / (1.1 * half_width));
    const double round = std::sqrt(std::max(0.0, 1.0 - (1.0 - tip) * (1.0 - tip)));
    const double joint = std::exp(-std::pow((along - kDistal / (kDistal + kProximal)) / 0.1, 2.0));
    look.half_widths.push_back(half_width * round * (0.84 + 0.2 * along + 0.09 * joint));
  }
  return look;
}

/// The back of the hand below the fingers, and a sleeve.
struct Hand {
  StrandLook back;
  StrandLook sleeve;
  StrandLook folded;
};

Hand paintHand(double unit, cv::RNG& rng) {
  Hand hand;
  hand.back.strip = paintMottle({240, 160}, kSkin, 9.0, rng);
  addGrain(4.0, 1.5, rng, hand.back.strip);
  cv::Mat1b tendons(hand.back.strip.size(), uchar(0));
  for (const double y : {0.25, 0.45, 0.66}) {
    cv::line(tendons, {10, cvRound(160 * y)}, {200, cvRound(160 * (0.4 + 0.2 * y))}, 70, 9);
  }
  cv::GaussianBlur(tendons, tendons, {0, 0}, 6.0);
  tint(tendons, {105.0, 130.0, 185.0}, hand.back.strip);
  shadeSkin(hand.back.strip);
  for (const double width : {0.055, 0.098, 0.112, 0.113, 0.11, 0.103, 0.092, 0.08, 0.072, 0.07}) {
    hand.back.half_widths.push_back(width * unit);
  }
  hand.sleeve.strip = paintMottle({120, 160}, {95.0, 70.0, 55.0}, 10.0, rng);
  for (int x = 0; x < 120; x += 8) hand.sleeve.strip.colRange(x, x + 2) *= 0.75;
  addGrain(7.0, 0.8, rng, hand.sleeve.strip);
  shadeSkin(hand.sleeve.strip);
  hand.sleeve.half_widths = {0.092 * unit, 0.1 * unit, 0.11 * unit};
  hand.folded = paintFinger(0.16 * unit, 1.05 * kHalfWidth * unit, rng);
  return hand;
}

/// Bound in leather of the skin's colour, out of focus as its neighbours.
Sprite paintBookSpine(double unit, cv::RNG& rng) {
  const cv::Size size(cvRound(unit * rng.uniform(0.06, 0.12)), cvRound(unit * 0.3));
  cv::Mat3b color = paintMottle(size, kSkin, 7.0, rng);
  for (const int percent : {20, 32, 80}) {
    cv::rectangle(color, cv::Rect(0, size.height * percent / 100, size.width, size.height / 30),
                  {85.0, 105.0, 165.0}, cv::FILLED);
  }
  for (int x = 0; x < size.width; ++x) color.col(x) *= 1.1 - 0.4 * x / size.width;
  cv::Mat1b coverage(size, uchar(0));
  cv::rectangle(coverage, cv::Rect(6, 6, size.width - 12, size.height - 12), 255, cv::FILLED);
  cv::GaussianBlur(color, color, {0, 0}, 2.0);
  cv::GaussianBlur(coverage, coverage, {0, 0}, 2.0);
  return {color, coverage, {0.5 * size.width, 0.5 * size.height}, 1.0};
}

class FingerPair : public SceneObject {
 public:
  FingerPair(const SceneOptions& options, cv::RNG& rng)
      : unit_(shorterSide(options)), hand_(paintHand(unit_, rng)) {
    const SmoothMotion usual(2.0, rng);
    for (int i = 0; i < 2; ++i) {
      fingers_[i] = paintFinger((kDistal + kProximal) * unit_, kHalfWidth * unit_, rng);
      swings_.emplace_back(2.0, rng);
      bends_.emplace_back(2.0, rng);
    }
    turn_ = options.rotation / usual.fastestStep();
  }

  SceneHabits habits() const override {
    SceneHabits habits;
    habits.motion = {{0.5, 0.62}, {0.18, 0.1}, 0.0, 0.35};
    return habits;
  }
  double length() const override { return (kDistal + kProximal) * unit_; }
  double radius() const override { return unit_; }

  ObjectTruth truthAt(const ObjectState& state) const override {
    ObjectTruth truth;
    truth.points = jointsAt(state);
    const double scale = state.image_from_object.scale;
    for (size_t i = 0; i + 1 < truth.points.size(); ++i) {
      const cv::Point2d along = truth.points[i + 1] - truth.points[i];
      truth.segments.push_back({directionOf(along), scale, truth.points[i]});
    }
    truth.box = strandBounds(lineOf(truth.points, 0), fingers_[0], scale) |
                strandBounds(lineOf(truth.points, 1), fingers_[1], scale);
    return truth;
  }

  void paint(const ObjectState& state, Layer& layer) const override {
    const std::vector<cv::Point2d> joints = jointsAt(state);
    for (const int finger : {1, 0}) {
      paintStrand(lineOf(joints, finger), fingers_[finger], state.image_from_object.scale, layer);
    }
  }

  void paintCompanions(const ObjectState& state, Layer& layer) const override {
    const Similarity& pose = state.image_from_object;
    const auto stretch = [&](const cv::Point2d& from, const cv::Point2d& to) {
      return resampleLine({pose.apply(unit_ * from), pose.apply(unit_ * to)}, 9);
    };
    paintStrand(stretch({0.0, -0.055}, {0.01, 0.34}), hand_.back, pose.scale, layer);
    paintStrand(stretch({0.012, 0.3}, {0.06, 0.95}), hand_.sleeve, pose.scale, layer);
    paintStrand(stretch({0.115, 0.12}, {0.1, -0.03}), hand_.folded, pose.scale, layer);
    paintStrand(stretch({0.06, 0.13}, {0.055, -0.04}), hand_.folded, pose.scale, layer);
  }

  void paintDecoy(const Similarity& image_from_decoy, cv::RNG& rng, Layer& layer) const override {
    paintBookSpine(unit_, rng)
        .paint({0.0, image_from_decoy.scale, image_from_decoy.translation}, layer);
  }

 private:
  /// Tip A, knuckle A, root, knuckle B, tip B.
  std::vector<cv::Point2d> jointsAt(const ObjectState& state) const {
    std::vector<cv::Point2d> joints(5);
    for (size_t finger = 0; finger < 2; ++finger) {
      const double swing = turn_ * kSwing * swings_[finger].at(state.turning_time);
      const double bend = turn_ * kBend * bends_[finger].at(state.turning_time);
      const double direction = -CV_PI / 2.0 + kSpread[finger] + swing;
      const cv::Point2d knuckle =
          kProximal * unit_ * cv::Point2d(std::cos(direction), std::sin(direction));
      const cv::Point2d tip =
          knuckle +
          kDistal * unit_ * cv::Point2d(std::cos(direction + bend), std::sin(direction + bend));
      joints[finger == 0 ? 1 : 3] = state.image_from_object.apply(knuckle);
      joints[finger == 0 ? 0 : 4] = state.image_from_object.apply(tip);
    }
    joints[2] = state.image_from_object.translation;
    return joints;
  }

  static std::vector<cv::Point2d> lineOf(const std::vector<cv::Point2d>& joints, int finger) {
    const size_t tip = finger == 0 ? 0 : 4;
    const size_t knuckle = finger == 0 ? 1 : 3;
    // Equal steps along the finger: the distal phalanx is a little shorter.
    const int distal = 1 + cvRound((kLinePoints - 1) * kDistal / (kDistal + kProximal));
    std::vector<cv::Point2d> line = resampleLine({joints[tip], joints[knuckle]}, distal);
    const std::vector<cv::Point2d> rest =
        resampleLine({joints[knuckle], joints[2]}, kLinePoints - distal + 1);
    line.insert(line.end(), rest.begin() + 1, rest.end());
    return line;
  }

  double unit_;
  Hand hand_;
  StrandLook fingers_[2];
  std::vector<SmoothMotion> swings_;
  std::vector<SmoothMotion> bends_;
  double turn_ = 1.0;
};

}  // namespace

/// Two fingers of a hand that open, close and bend. Its points go from one tip over the root to the
/// other.
SceneObjectPtr makeFingerPair(const SceneOptions& options, cv::RNG& rng) {
  return std::make_unique<FingerPair>(options, rng);
}

}  // namespace chain_tracker
