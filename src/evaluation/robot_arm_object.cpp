// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "rigid_object.h"
#include "scene_object.h"
#include "scene_textures.h"

namespace chain_tracker {
namespace {

constexpr int kLinks = 3;
/// Of the links, in fractions of the image's shorter side.
constexpr double kLengths[kLinks] = {0.25, 0.21, 0.16};
constexpr double kStartRadii[kLinks] = {0.055, 0.044, 0.033};
constexpr double kEndRadii[kLinks] = {0.042, 0.032, 0.018};
/// Where the joints are at rest and how far they turn, in shares of the turning asked for.
constexpr double kRest[kLinks] = {-CV_PI / 2.0 - 0.2, 0.5, 0.6};
constexpr double kTurn[kLinks] = {0.5, 0.9, 1.0};
/// Where the gripper's jaws begin, of its length.
constexpr double kPalm = 0.55;
constexpr double kSpritePixels = 2.0;

const cv::Scalar kPaint(30.0, 140.0, 235.0);
const cv::Scalar kSteel(165.0, 160.0, 155.0);
const cv::Scalar kDark(55.0, 52.0, 50.0);

struct LinkShape {
  double length;
  double start_radius;
  double end_radius;
};

/// A picture of `shape` with room around it; the first joint is at `origin`.
struct LinkCanvas {
  explicit LinkCanvas(const LinkShape& shape)
      : size(cvRound(kSpritePixels * (shape.length + 2.0 * shape.start_radius) + 12.0),
             cvRound(kSpritePixels * 2.0 * shape.start_radius + 12.0)),
        origin(kSpritePixels * shape.start_radius + 6.0, 0.5 * (size.height - 1)),
        color(size),
        coverage(size, uchar(0)) {}

  cv::Point at(double x, double y) const {
    return {cvRound(origin.x + kSpritePixels * x), cvRound(origin.y + kSpritePixels * y)};
  }
  static int side(double length) { return std::max(1, cvRound(kSpritePixels * length)); }

  cv::Size size;
  cv::Point2d origin;
  cv::Mat3b color;
  cv::Mat1b coverage;
};

/// A round cap with a ring of bolts.
void paintJoint(LinkCanvas& canvas, double x, double radius) {
  const cv::Point middle = canvas.at(x, 0.0);
  cv::circle(canvas.color, middle, LinkCanvas::side(0.82 * radius), kDark, cv::FILLED, cv::LINE_AA);
  cv::circle(canvas.color, middle, LinkCanvas::side(0.62 * radius), kSteel, cv::FILLED,
             cv::LINE_AA);
  cv::circle(canvas.color, middle - cv::Point(2, 2), LinkCanvas::side(0.4 * radius),
             {205.0, 203.0, 200.0}, LinkCanvas::side(0.12 * radius), cv::LINE_AA);
  for (int bolt = 0; bolt < 6; ++bolt) {
    const double phi = CV_PI / 3.0 * bolt + 0.3;
    const cv::Point at = canvas.at(x + 0.5 * radius * std::cos(phi), 0.5 * radius * std::sin(phi));
    cv::circle(canvas.color, at, LinkCanvas::side(0.08 * radius), kDark, cv::FILLED, cv::LINE_AA);
  }
}

void fillTaper(cv::Mat& image, const LinkCanvas& canvas, const LinkShape& shape, double from,
               double to, double share, const cv::Scalar& value) {
  const auto radius = [&](double x) {
    const double along = std::clamp(x / shape.length, 0.0, 1.0);
    return share * ((1.0 - along) * shape.start_radius + along * shape.end_radius);
  };
  const std::vector<cv::Point> corners{canvas.at(from, -radius(from)), canvas.at(to, -radius(to)),
                                       canvas.at(to, radius(to)), canvas.at(from, radius(from))};
  cv::fillConvexPoly(image, corners, value, cv::LINE_AA);
}

/// A cast link: painted metal, a darker rib, hazard stripes, a decal.
Sprite paintLink(const LinkShape& shape, cv::RNG& rng) {
  LinkCanvas canvas(shape);
  canvas.color = paintMottle(canvas.size, kPaint, 6.0, rng);
  fillTaper(canvas.color, canvas, shape, 0.3 * shape.length, 0.82 * shape.length, 0.5,
            {20.0, 95.0, 180.0});
  fillTaper(canvas.color, canvas, shape, 0.33 * shape.length, 0.79 * shape.length, 0.38,
            {26.0, 120.0, 212.0});
  const int stripe = canvas.side(0.05 * shape.length);
  for (int i = 0; i < 3; ++i) {
    const cv::Point top = canvas.at((0.85 + 0.045 * i) * shape.length, -shape.end_radius);
    const cv::Point bottom = canvas.at((0.8 + 0.045 * i) * shape.length, shape.end_radius);
    cv::line(canvas.color, top, bottom, kDark, std::max(1, stripe / 3), cv::LINE_AA);
  }
  cv::putText(canvas.color, "R6-20", canvas.at(0.36 * shape.length, 0.16 * shape.start_radius),
              cv::FONT_HERSHEY_DUPLEX, shape.length / 220.0, {235.0, 238.0, 240.0}, 1, cv::LINE_AA);
  fillTaper(canvas.coverage, canvas, shape, 0.0, shape.length, 1.0, cv::Scalar(255.0));
  cv::circle(canvas.coverage, canvas.at(0.0, 0.0), canvas.side(shape.start_radius), 255, cv::FILLED,
             cv::LINE_AA);
  cv::circle(canvas.coverage, canvas.at(shape.length, 0.0), canvas.side(shape.end_radius), 255,
             cv::FILLED, cv::LINE_AA);
  for (int row = 0; row < canvas.size.height; ++row) {
    const double across = 2.0 * row / canvas.size.height - 1.0;
    canvas.color.row(row) *= 1.08 - 0.3 * across - 0.25 * across * across;
  }
  paintJoint(canvas, 0.0, shape.start_radius);
  paintJoint(canvas, shape.length, shape.end_radius);
  addGrain(4.0, 0.8, rng, canvas.color);
  return {canvas.color, canvas.coverage, canvas.origin, kSpritePixels};
}

/// One of two jaws; the other is its mirror image.
std::vector<cv::Point2d> jawCorners(double length, double radius) {
  const double palm = kPalm * length;
  return {{0.5 * palm, 0.6 * radius}, {palm, 1.35 * radius}, {0.8 * length, 1.2 * radius},
          {length, 0.28 * radius},    {length, 0.0},         {0.78 * length, 0.45 * radius},
          {palm, 0.5 * radius}};
}

/// The wrist with a gripper whose jaws end at the link's end.
Sprite paintGripper(const LinkShape& shape, cv::RNG& rng) {
  LinkCanvas canvas(shape);
  canvas.color = paintMottle(canvas.size, kSteel, 8.0, rng);
  const double palm = kPalm * shape.length;
  fillTaper(canvas.coverage, canvas, shape, 0.0, palm, 1.0, cv::Scalar(255.0));
  cv::circle(canvas.coverage, canvas.at(0.0, 0.0), canvas.side(shape.start_radius), 255, cv::FILLED,
             cv::LINE_AA);
  for (const double side : {-1.0, 1.0}) {
    std::vector<cv::Point> jaw;
    for (const cv::Point2d& corner : jawCorners(shape.length, shape.end_radius)) {
      jaw.push_back(canvas.at(corner.x, side * corner.y));
    }
    cv::fillPoly(canvas.coverage, std::vector<std::vector<cv::Point>>{jaw}, 255, cv::LINE_AA);
  }
  cv::rectangle(canvas.color,
                cv::Rect(canvas.at(0.35 * shape.length, -shape.start_radius),
                         canvas.at(0.45 * shape.length, shape.start_radius)),
                kPaint, cv::FILLED);
  for (int row = 0; row < canvas.size.height; ++row) {
    const double across = 2.0 * row / canvas.size.height - 1.0;
    canvas.color.row(row) *= 1.0 - 0.35 * across - 0.2 * across * across;
  }
  cv::line(canvas.color, canvas.at(palm, 0.0), canvas.at(shape.length, 0.0), kDark, 2, cv::LINE_AA);
  paintJoint(canvas, 0.0, shape.start_radius);
  addGrain(4.0, 0.8, rng, canvas.color);
  return {canvas.color, canvas.coverage, canvas.origin, kSpritePixels};
}

/// The column that it stands on: goes down from the origin, out of the picture.
Sprite paintPedestal(double size, cv::RNG& rng) {
  const int side = cvRound(2.0 * size * kSpritePixels);
  const int height = side * 2;
  cv::Mat3b color = paintMottle({side, height}, {85.0, 82.0, 80.0}, 7.0, rng);
  cv::Mat1b coverage(height, side, uchar(0));
  const int middle = side / 2;
  const std::vector<cv::Point> body{{middle - side / 6, middle},
                                    {middle + side / 6, middle},
                                    {middle + side / 5, height - 1},
                                    {middle - side / 5, height - 1}};
  cv::fillConvexPoly(coverage, body, 255, cv::LINE_AA);
  cv::circle(coverage, {middle, middle}, side / 6, 255, cv::FILLED, cv::LINE_AA);
  for (const int y : {side * 3 / 4, side * 5 / 4, side * 7 / 4}) {
    cv::rectangle(color, cv::Rect(0, y, side, side / 40), {55.0, 52.0, 50.0}, cv::FILLED);
  }
  cv::rectangle(color, cv::Rect(0, side * 5 / 6, side, side / 16), kPaint, cv::FILLED);
  for (int x = 0; x < side; ++x) color.col(x) *= 1.25 - 0.6 * x / side;
  addGrain(4.0, 0.8, rng, color);
  return {color, coverage, {0.5 * side, 0.5 * side}, kSpritePixels};
}

/// A guard rail in the arm's paint, with posts.
Sprite paintBarrier(double unit, cv::RNG& rng) {
  const cv::Size size(cvRound(unit * rng.uniform(0.4, 0.7)), cvRound(unit * 0.3));
  cv::Mat3b color = paintMottle(size, kPaint, 6.0, rng);
  cv::Mat1b coverage(size, uchar(0));
  const int rail = size.height / 6;
  for (const int y : {rail / 2, rail * 5 / 2}) {
    cv::rectangle(coverage, cv::Rect(3, y, size.width - 6, rail), 255, cv::FILLED);
  }
  for (const int x : {size.width / 8, size.width * 6 / 8}) {
    cv::rectangle(coverage, cv::Rect(x, rail / 2, rail, size.height - rail), 255, cv::FILLED);
    cv::rectangle(color, cv::Rect(x, rail * 4, rail, size.height), kSteel, cv::FILLED);
  }
  for (int x = -size.height; x < size.width; x += 3 * rail) {
    cv::line(color, {x, 3 * rail / 2}, {x + rail, rail / 2}, kDark, std::max(1, rail / 2));
  }
  cv::GaussianBlur(color, color, {0, 0}, 1.5);
  cv::GaussianBlur(coverage, coverage, {0, 0}, 1.5);
  return {color, coverage, {0.5 * size.width, 0.5 * size.height}, 1.0};
}

class RobotArm : public SceneObject {
 public:
  RobotArm(const SceneOptions& options, cv::RNG& rng)
      : unit_(shorterSide(options)), pedestal_(paintPedestal(0.13 * unit_, rng)) {
    for (int i = 0; i < kLinks; ++i) {
      const LinkShape shape{unit_ * kLengths[i], unit_ * kStartRadii[i], unit_ * kEndRadii[i]};
      links_.push_back(i + 1 < kLinks ? paintLink(shape, rng) : paintGripper(shape, rng));
      joints_.emplace_back(2.0, rng);
      swings_[i] = kTurn[i] * options.rotation / joints_.back().fastestStep();
    }
  }

  SceneHabits habits() const override {
    SceneHabits habits;
    habits.motion = {{0.45, 0.74}, {0.1, 0.06}, 0.0, 0.0};
    return habits;
  }
  double length() const override { return unit_ * (kLengths[0] + kLengths[1] + kLengths[2]); }

  ObjectTruth truthAt(const ObjectState& state) const override {
    ObjectTruth truth;
    truth.segments = linksAt(state);
    std::vector<cv::Point2d> rims;
    for (int i = 0; i < kLinks; ++i) {
      const Similarity& link = truth.segments[static_cast<size_t>(i)];
      truth.points.push_back(link.translation);
      addDisc(link.translation, unit_ * kStartRadii[i] * link.scale, rims);
      const cv::Point2d end = link.apply({unit_ * kLengths[i], 0.0});
      if (i + 1 == kLinks) {
        truth.points.push_back(end);
        for (const cv::Point2d& corner : jawCorners(unit_ * kLengths[i], unit_ * kEndRadii[i])) {
          rims.push_back(link.apply(corner));
          rims.push_back(link.apply({corner.x, -corner.y}));
        }
      } else {
        addDisc(end, unit_ * kEndRadii[i] * link.scale, rims);
      }
    }
    truth.box = uprightBounds(rims);
    return truth;
  }

  void paint(const ObjectState& state, Layer& layer) const override {
    const std::vector<Similarity> links = linksAt(state);
    for (size_t i = 0; i < links.size(); ++i) links_[i].paint(links[i], layer);
  }

  void paintCompanions(const ObjectState& state, Layer& layer) const override {
    pedestal_.paint(state.image_from_object, layer);
  }

  void paintDecoy(const Similarity& image_from_decoy, cv::RNG& rng, Layer& layer) const override {
    paintBarrier(unit_, rng)
        .paint({0.0, image_from_decoy.scale, image_from_decoy.translation}, layer);
  }

 private:
  static void addDisc(const cv::Point2d& middle, double radius, std::vector<cv::Point2d>& points) {
    points.push_back(middle - cv::Point2d(radius, radius));
    points.push_back(middle + cv::Point2d(radius, radius));
  }

  /// Frames of the links: at their first joint, along +x.
  std::vector<Similarity> linksAt(const ObjectState& state) const {
    std::vector<Similarity> links;
    Similarity link = state.image_from_object;
    for (int i = 0; i < kLinks; ++i) {
      link.angle += kRest[i] + swings_[i] * joints_[static_cast<size_t>(i)].at(state.turning_time);
      links.push_back(link);
      link.translation = link.apply({unit_ * kLengths[i], 0.0});
    }
    return links;
  }

  double unit_;
  Sprite pedestal_;
  std::vector<Sprite> links_;
  std::vector<SmoothMotion> joints_;
  double swings_[kLinks] = {};
};

}  // namespace

/// An industrial arm of three links. Its points are the base, two joints and the gripper's tip.
SceneObjectPtr makeRobotArm(const SceneOptions& options, cv::RNG& rng) {
  return std::make_unique<RobotArm>(options, rng);
}

}  // namespace chain_tracker
