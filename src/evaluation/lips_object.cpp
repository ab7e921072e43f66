// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "scene_object.h"
#include "scene_textures.h"

namespace chain_tracker {
namespace {

/// Of the mouth at rest, in fractions of the image's shorter side.
constexpr double kWidth = 0.36;
constexpr double kUpper = 0.058;
constexpr double kLower = 0.075;
constexpr double kOpening = 0.13;
/// Material points are on the outline, at these shares of half the width; then back below.
constexpr double kUpperShares[7] = {-1.0, -0.66, -0.33, 0.0, 0.33, 0.66, 1.0};
constexpr double kFacePixels = 1.0;

const cv::Scalar kSkin(150.0, 175.0, 218.0);

/// The mouth's curves at one moment, over u from -1 to 1 across it; y down, in px at scale 1.
struct Mouth {
  double half_width;
  double opening;
  double upper;
  double lower;

  static double arch(double u, double power) { return std::pow(std::max(0.0, 1.0 - u * u), power); }
  double upperRim(double u) const {
    const double bow = 1.0 - 0.22 * std::exp(-std::pow(u / 0.17, 2.0));
    return -0.3 * opening * arch(u, 1.0) - upper * arch(u, 0.8) * bow;
  }
  double upperEdge(double u) const {
    return -0.3 * opening * arch(u / 0.93, 1.0) + 0.1 * upper * arch(u, 1.0);
  }
  double lowerEdge(double u) const {
    return 0.7 * opening * arch(u / 0.93, 1.0) + 0.1 * upper * arch(u, 1.0);
  }
  double lowerRim(double u) const {
    return 0.7 * opening * arch(u, 1.0) + lower * arch(u, 0.75) + 0.1 * upper * arch(u, 1.0);
  }
};

/// A wide Gaussian blur, computed coarsely.
void soften(double sigma, cv::Mat1b& weight) {
  const double step = std::max(1.0, sigma / 3.0);
  const cv::Size coarse(std::max(1, cvRound(weight.cols / step)),
                        std::max(1, cvRound(weight.rows / step)));
  cv::Mat1b small;
  cv::resize(weight, small, coarse, 0.0, 0.0, cv::INTER_AREA);
  cv::GaussianBlur(small, small, {0, 0}, std::max(0.5, sigma / step));
  cv::resize(small, weight, weight.size(), 0.0, 0.0, cv::INTER_CUBIC);
}

/// Fills what the face leaves free: a neck `half` to either side of the middle, else hair.
void putNeckAndHairBehind(cv::Mat1b& face, int half, cv::RNG& rng, cv::Mat3b& color) {
  const cv::Size turned(color.rows, color.cols);
  cv::Mat3b hair;
  cv::transpose(paintWood(turned, {32.0, 42.0, 62.0}, 16.0, rng), hair);
  const cv::Rect neck(color.cols / 2 - half, color.rows / 2, 2 * half, color.rows / 2);
  cv::Mat3b skin = paintMottle(neck.size(), 0.62 * kSkin, 6.0, rng);
  for (int x = 0; x < skin.cols; ++x) {
    const double across = 2.0 * x / skin.cols - 1.0;
    skin.col(x) *= 1.0 - 0.5 * across * across;
  }
  skin.copyTo(hair(neck));
  cv::GaussianBlur(face, face, {0, 0}, 1.5);
  const cv::Mat3b front = color.clone();
  color = hair;
  for (int row = 0; row < color.rows; ++row) {
    for (int x = 0; x < color.cols; ++x) {
      const double share = face(row, x) / 255.0;
      color(row, x) = (1.0 - share) * cv::Vec3d(color(row, x)) + share * cv::Vec3d(front(row, x));
    }
  }
}

/// Skin of a face from below the eyes to the chin, around the mouth at its centre.
Sprite paintFace(double unit, cv::RNG& rng) {
  const int side = cvRound(2.4 * unit * kFacePixels);
  const cv::Point mouth(side / 2, side / 2);
  const auto px = [&](double fraction) { return cvRound(fraction * unit * kFacePixels); };
  cv::Mat3b color = paintMottle({side, side}, kSkin, 6.0, rng);
  addGrain(4.0, 1.3, rng, color);
  const auto shadow = [&](const cv::Point& at, const cv::Size& half, double angle, int strength,
                          double softness, const cv::Scalar& tone) {
    const cv::Size reach = half + cv::Size(3 * px(softness), 3 * px(softness));
    const int radius = std::max(reach.width, reach.height);
    const cv::Rect area =
        cv::Rect(mouth + at - cv::Point(radius, radius), cv::Size(2 * radius, 2 * radius)) &
        cv::Rect(cv::Point(), color.size());
    cv::Mat1b weight(area.size(), uchar(0));
    cv::ellipse(weight, mouth + at - area.tl(), half, angle, 0.0, 360.0, strength, cv::FILLED);
    soften(px(softness), weight);
    cv::Mat3b part = color(area);
    tint(weight, tone, part);
  };
  const cv::Scalar dim(90.0, 115.0, 170.0);
  shadow({0, px(0.2)}, {px(0.15), px(0.03)}, 0.0, 150, 0.025, dim);
  shadow({0, px(0.36)}, {px(0.14), px(0.09)}, 0.0, 110, 0.05, {180.0, 205.0, 240.0});
  shadow({0, px(-0.13)}, {px(0.025), px(0.06)}, 0.0, 120, 0.015, dim);
  for (const int half : {-1, 1}) {
    shadow({half * px(0.28), px(-0.1)}, {px(0.018), px(0.17)}, -28.0 * half, 120, 0.02, dim);
    shadow({half * px(0.42), px(-0.22)}, {px(0.16), px(0.13)}, 0.0, 130, 0.07,
           {135.0, 145.0, 225.0});
    shadow({half * px(0.12), px(-0.27)}, {px(0.05), px(0.06)}, 0.0, 130, 0.02, dim);
    shadow({half * px(0.06), px(-0.235)}, {px(0.03), px(0.013)}, 12.0 * half, 235, 0.006,
           {35.0, 40.0, 75.0});
  }
  shadow({0, px(-0.21)}, {px(0.09), px(0.02)}, 0.0, 140, 0.02, dim);
  shadow({0, px(-0.36)}, {px(0.035), px(0.14)}, 0.0, 130, 0.025, {190.0, 212.0, 245.0});
  // Darker towards the jaw: the face turns away from the light.
  cv::Mat1b far(color.size(), uchar(190));
  cv::ellipse(far, mouth - cv::Point(0, px(0.35)), {px(0.56), px(0.86)}, 0.0, 0.0, 360.0, 0,
              cv::FILLED);
  soften(px(0.1), far);
  tint(far, {45.0, 62.0, 105.0}, color);
  shadeUnevenly(0.3, rng, color);
  cv::Mat1b face(color.size(), uchar(0));
  const cv::Point middle = mouth - cv::Point(0, px(0.35));
  cv::ellipse(face, middle, {px(0.68), px(0.98)}, 0.0, 0.0, 360.0, 255, cv::FILLED, cv::LINE_AA);
  cv::Mat1b coverage(color.size(), uchar(0));
  cv::ellipse(coverage, middle, {px(0.86), px(1.18)}, 0.0, 0.0, 360.0, 255, cv::FILLED,
              cv::LINE_AA);
  putNeckAndHairBehind(face, px(0.4), rng, color);
  cv::rectangle(coverage, cv::Rect(mouth.x - px(0.4), mouth.y, px(0.8), side / 2), 255, cv::FILLED);
  cv::GaussianBlur(coverage, coverage, {0, 0}, 2.0);
  return {color, coverage, {0.5 * (side - 1), 0.5 * (side - 1)}, kFacePixels};
}

class Lips : public SceneObject {
 public:
  Lips(const SceneOptions& options, cv::RNG& rng)
      : unit_(shorterSide(options)),
        face_(paintFace(unit_, rng)),
        skin_(paintMottle({256, 64}, {105.0, 100.0, 200.0}, 9.0, rng)),
        opening_(9.0, rng),
        width_(6.0, rng) {
    for (int crease = 0; crease < 70; ++crease) {
      const int x = rng.uniform(0, skin_.cols);
      cv::line(skin_, {x, 0}, {x + rng.uniform(-3, 4), skin_.rows}, {85.0, 78.0, 172.0}, 1,
               cv::LINE_AA);
    }
  }

  SceneHabits habits() const override {
    SceneHabits habits;
    habits.motion = {{0.5, 0.56}, {0.12, 0.1}, 0.0, 0.4};
    habits.clutter = 0;
    habits.shadow = 0.0;
    return habits;
  }
  double length() const override { return kWidth * unit_; }
  double radius() const override { return 1.4 * unit_; }

  ObjectTruth truthAt(const ObjectState& state) const override {
    const Mouth mouth = mouthAt(state.bending_time);
    std::vector<cv::Point2d> points;
    for (const double u : kUpperShares) {
      points.push_back({u * mouth.half_width, mouth.upperRim(u)});
    }
    for (int i = 5; i >= 1; --i) {
      const double u = kUpperShares[i];
      points.push_back({u * mouth.half_width, mouth.lowerRim(u)});
    }
    std::vector<cv::Point2d> rims;
    for (int percent = -100; percent <= 100; percent += 2) {
      const double u = 0.01 * percent;
      rims.push_back({u * mouth.half_width, mouth.upperRim(u)});
      rims.push_back({u * mouth.half_width, mouth.lowerRim(u)});
    }
    for (cv::Point2d& point : points) point = state.image_from_object.apply(point);
    for (cv::Point2d& point : rims) point = state.image_from_object.apply(point);
    return {points, {}, uprightBounds(rims)};
  }

  void paint(const ObjectState& state, Layer& layer) const override {
    paintMouth(mouthAt(state.bending_time), state.image_from_object, layer);
  }

  void paintCompanions(const ObjectState& state, Layer& layer) const override {
    face_.paint(state.image_from_object, layer);
  }

  void paintDecoy(const Similarity& image_from_decoy, cv::RNG& rng, Layer& layer) const override {
    const Mouth closed{unit_ * rng.uniform(0.05, 0.12), 0.0, unit_ * rng.uniform(0.05, 0.1),
                       unit_ * rng.uniform(0.05, 0.1)};
    paintMouth(closed, image_from_decoy, layer);
  }

 private:
  Mouth mouthAt(double time) const {
    const double open = std::clamp(0.45 + 0.75 * opening_.at(time), 0.0, 1.0);
    return {0.5 * kWidth * unit_ * (1.0 - 0.1 * open + 0.08 * width_.at(time)),
            kOpening * unit_ * open, kUpper * unit_, kLower * unit_ * (1.0 - 0.15 * open)};
  }

  void paintMouth(const Mouth& mouth, const Similarity& pose, Layer& layer) const {
    const double high = mouth.upper + mouth.opening;
    const double low = mouth.lower + mouth.opening;
    std::vector<cv::Point2d> corners;
    for (const double x : {-mouth.half_width, mouth.half_width}) {
      corners.push_back(pose.apply({x, -high}));
      corners.push_back(pose.apply({x, low}));
    }
    const cv::Rect region = pixelsWithin(uprightBounds(corners), 2.0, layer);
    if (region.empty()) return;
    cv::Mat4b piece(region.size(), cv::Vec4b::all(0));
    const ObjectGrid grid(pose, region.tl());
    for (int y = 0; y < region.height; ++y) {
      for (int x = 0; x < region.width; ++x) {
        piece(y, x) = pixelAt(mouth, grid.at(x, y), pose.scale);
      }
    }
    layer.paint(piece, region.tl());
  }

  cv::Vec4b pixelAt(const Mouth& mouth, const cv::Point2d& at, double scale) const {
    const double u = at.x / mouth.half_width;
    if (std::abs(u) >= 1.0) return cv::Vec4b::all(0);
    const double top = mouth.upperRim(u);
    const double bottom = mouth.lowerRim(u);
    const double inside = std::min(at.y - top, bottom - at.y) * scale;
    const double covered = std::clamp(inside + 0.5, 0.0, 1.0);
    if (covered <= 0.0) return cv::Vec4b::all(0);
    const double upper_edge = std::min(mouth.upperEdge(u), mouth.lowerEdge(u));
    const double lower_edge = mouth.lowerEdge(u);
    // Between the lips: teeth above, dark below.
    const double gap =
        std::clamp(std::min(at.y - upper_edge, lower_edge - at.y) * scale + 0.5, 0.0, 1.0);
    const bool above = at.y < 0.5 * (upper_edge + lower_edge);
    const double depth = above ? (at.y - top) / std::max(upper_edge - top, 1.0)
                               : (bottom - at.y) / std::max(bottom - lower_edge, 1.0);
    const cv::Vec3d lip = lipColor(u, std::clamp(depth, 0.0, 1.0), above);
    const cv::Vec3d color = (1.0 - gap) * lip + gap * insideColor(u, at.y - upper_edge);
    // The outline of lips is soft.
    return coveredPixel(color, covered * std::clamp(0.7 + 0.1 * inside, 0.0, 1.0));
  }

  /// `depth`: 0 at the outline, 1 at the edge towards the other lip.
  cv::Vec3d lipColor(double u, double depth, bool above) const {
    const int x = std::clamp(cvRound((0.5 + 0.5 * u) * (skin_.cols - 1)), 0, skin_.cols - 1);
    const int y = cvRound((above ? depth : 1.0 - depth) * (skin_.rows - 1));
    const double bulge = above ? 0.88 - 0.25 * depth : 0.82 + 0.5 * depth * (1.1 - depth);
    const double shine = above ? 0.0
                               : 45.0 * std::exp(-std::pow((depth - 0.55) / 0.16, 2.0) -
                                                 std::pow((u + 0.1) / 0.4, 2.0));
    const double crease = 1.0 - 0.35 * std::pow(depth, 8.0);
    return cv::Vec3d(skin_(y, x)) * bulge * crease + cv::Vec3d::all(shine);
  }

  /// `below`: distance from the upper lip's edge, at scale 1 [px].
  cv::Vec3d insideColor(double u, double below) const {
    const double tooth = 0.05 * unit_;
    const double length = tooth * (0.85 - 0.35 * u * u);
    if (below > length || std::abs(u) > 0.8) return {38.0, 28.0, 62.0 + 25.0 * below / tooth};
    const double gap = std::abs(std::remainder(u * kWidth * 0.5 * unit_ / tooth, 1.0)) * tooth;
    const double light = (0.72 + 0.28 * std::min(1.0, gap / 2.0)) * (1.0 - 0.45 * u * u) *
                         std::min(1.0, 0.6 + below / 12.0);
    return cv::Vec3d(190.0, 208.0, 216.0) * light;
  }

  double unit_;
  Sprite face_;
  cv::Mat3b skin_;
  SmoothMotion opening_;
  SmoothMotion width_;
};

}  // namespace

/// A speaking mouth in a face. 12 points around the lips' outline, clockwise from its left corner
/// in the picture.
SceneObjectPtr makeLips(const SceneOptions& options, cv::RNG& rng) {
  return std::make_unique<Lips>(options, rng);
}

}  // namespace chain_tracker
