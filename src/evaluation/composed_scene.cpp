// SPDX-License-Identifier: BSD-3-Clause
#include "composed_scene.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <opencv2/imgproc.hpp>

#include "chain_tracker/chain/similarity_fit.h"

namespace chain_tracker {
namespace {

/// Motion blur is the mean of pictures about this far apart [px], as far as the number allows.
constexpr double kExposureStep = 1.5;
constexpr int kMostExposures = 12;
/// Coverage from which a point counts as hidden.
constexpr int kHidden = 128;

cv::Point2d meanOf(const std::vector<cv::Point2d>& points) {
  return std::accumulate(points.begin(), points.end(), cv::Point2d()) /
         static_cast<double>(points.size());
}

/// The background needs room to move to and fro: a sixth of the image to each side.
double backgroundMargin(const SceneOptions& options) {
  if (options.background_speed <= 0.0) return 0.0;
  return cvRound(std::min(options.size.width, options.size.height) / 6.0);
}

cv::Size grown(const cv::Size& size, double margin) {
  const int twice = 2 * cvRound(margin);
  return {size.width + twice, size.height + twice};
}

}  // namespace

ComposedScene::ComposedScene(const SceneRecipe& recipe, const SceneOptions& options)
    : options_(options),
      model_(recipe.model),
      margin_(backgroundMargin(options)),
      rng_(options.seed),
      background_(recipe.paint_background(grown(options.size, margin_), rng_)),
      object_(recipe.make_object(options, rng_)),
      habits_(object_->habits()),
      motion_(options, habits_.motion, object_->radius(), rng_),
      extras_rng_(options.seed * 104729U + 1U),
      occluders_rng_(options.seed * 104729U + 2U),
      background_x_(1.0, extras_rng_),
      background_y_(1.0, extras_rng_),
      illumination_(options.illumination, extras_rng_),
      occluders_(options, object_->length(), occluders_rng_) {
  addClutter(extras_rng_);
  first_scale_ = motion_.at(0.0).image_from_object.scale;
  first_points_ = truthAt(0.0).points;
}

void ComposedScene::addClutter(cv::RNG& rng) {
  const int count = options_.clutter.value_or(habits_.clutter);
  for (int i = 0; i < count; ++i) {
    Layer layer(background_.size());
    const double x = background_.cols * rng.uniform(0.05, 0.95);
    const double y = background_.rows * rng.uniform(0.05, 0.95);
    const double angle = rng.uniform(0.0, 2.0 * CV_PI);
    object_->paintDecoy({angle, rng.uniform(0.6, 1.2), {x, y}}, rng, layer);
    layer.castShadow(shadow(), background_);
    layer.composite(background_);
  }
}

ObjectTruth ComposedScene::truthAt(double time) const {
  ObjectTruth truth = object_->truthAt(motion_.at(time));
  if (truth.segments.empty()) {
    std::vector<cv::Point2d> from = first_points_.empty() ? truth.points : first_points_;
    const cv::Point2d middle = meanOf(from);
    for (cv::Point2d& point : from) point -= middle;
    truth.segments = {
        fitSimilarity(from, truth.points, std::vector<double>(truth.points.size(), 1.0))};
  } else {
    for (Similarity& segment : truth.segments) {
      segment.scale /= first_scale_;
      segment.angle = wrapAngle(segment.angle);
    }
  }
  return truth;
}

int ComposedScene::exposuresFor(double distance) {
  return std::clamp(static_cast<int>(std::ceil(distance / kExposureStep)), 1, kMostExposures);
}

double ComposedScene::objectTravel(double frame) const {
  const ObjectTruth before = truthAt(frame - 0.5 * blur());
  const ObjectTruth after = truthAt(frame + 0.5 * blur());
  double farthest = 0.0;
  for (size_t i = 0; i < before.points.size(); ++i) {
    farthest = std::max(farthest, cv::norm(after.points[i] - before.points[i]));
  }
  return farthest;
}

double ComposedScene::surroundingsTravel(double frame) const {
  const Similarity before = motion_.at(frame - 0.5 * blur()).image_from_object;
  const Similarity after = motion_.at(frame + 0.5 * blur()).image_from_object;
  double farthest = blur() * options_.background_speed;
  const double radius = object_->radius();
  for (const cv::Point2d& rim : {cv::Point2d(radius, 0.0), cv::Point2d(-radius, 0.0),
                                 cv::Point2d(0.0, radius), cv::Point2d(0.0, -radius)}) {
    farthest = std::max(farthest, cv::norm(after.apply(rim) - before.apply(rim)));
  }
  return farthest;
}

cv::Mat3b ComposedScene::backgroundAt(double frame) const {
  if (options_.background_speed <= 0.0) return background_.clone();
  // Time runs such that the fastest shift is the one asked for; each axis has its share of it.
  const double rate =
      options_.background_speed / std::sqrt(2.0) / (margin_ * background_x_.fastestStep());
  const double time = frame / kFramesPerTime * rate;
  const cv::Matx23d moved(1.0, 0.0, margin_ * background_x_.at(time) - margin_, 0.0, 1.0,
                          margin_ * background_y_.at(time) - margin_);
  cv::Mat3b image;
  cv::warpAffine(background_, image, moved, options_.size, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return image;
}

Layer ComposedScene::occludersAt(double frame) const {
  Layer layer(options_.size);
  if (options_.occlusions < 1) return layer;
  const ObjectTruth truth = truthAt(frame);
  occluders_.paint(frame, meanOf(truth.points), motion_.at(frame).image_from_object.scale, layer);
  return layer;
}

cv::Mat3b ComposedScene::paintSurroundings(double frame) const {
  cv::Mat3b canvas = backgroundAt(frame);
  Layer companions(options_.size);
  object_->paintCompanions(motion_.at(frame), companions);
  companions.castShadow(shadow(), canvas);
  companions.composite(canvas);
  return canvas;
}

void ComposedScene::paintObject(double frame, cv::Mat3b& canvas) const {
  Layer object(options_.size);
  object_->paint(motion_.at(frame), object);
  object.castShadow(shadow(), canvas);
  object.composite(canvas);
  if (options_.occlusions < 1) return;
  const Layer occluders = occludersAt(frame);
  occluders.castShadow(shadow(), canvas);
  occluders.composite(canvas);
}

cv::Mat3b ComposedScene::expose(double frame, bool with_object) const {
  const int surroundings_exposures = exposuresFor(surroundingsTravel(frame));
  // The same moments with and without the object, so that the surroundings are the same.
  const int exposures = std::max(surroundings_exposures, exposuresFor(objectTravel(frame)));
  const auto moment = [&](int i, int count) { return frame + blur() * ((i + 0.5) / count - 0.5); };
  Exposure exposure(options_.size);
  cv::Mat3b surroundings;
  for (int i = 0, painted = -1; i < exposures; ++i) {
    const int due = i * surroundings_exposures / exposures;
    if (due != painted) surroundings = paintSurroundings(moment(due, surroundings_exposures));
    painted = due;
    cv::Mat3b canvas = surroundings.clone();
    if (with_object) paintObject(moment(i, exposures), canvas);
    if (exposures == 1) return canvas;
    exposure.add(canvas);
  }
  return exposure.mean();
}

cv::Mat3b ComposedScene::takePicture(int index, bool with_object) const {
  cv::Mat3b image = expose(index, with_object);
  illumination_.apply(index / kFramesPerTime, image);
  cv::RNG noise(options_.seed * 7919U + static_cast<std::uint32_t>(index) + 1U);
  if (options_.grey) {
    makeGrey(image);
    addGreyNoise(image, options_.noise, noise);
  } else {
    addNoise(image, options_.noise, noise);
  }
  return image;
}

SceneFrame ComposedScene::render(int index) const {
  SceneFrame frame;
  frame.image = takePicture(index, true);
  const ObjectTruth truth = truthAt(index);
  frame.points = truth.points;
  frame.segments = truth.segments;
  frame.box = truth.box;
  frame.image_from_object = motion_.at(index).image_from_object;
  frame.image_from_object.scale /= first_scale_;
  const cv::Rect image(cv::Point(), options_.size);
  // Pixels reach half a pixel beyond their centres.
  const cv::Rect2d view(-0.5, -0.5, options_.size.width, options_.size.height);
  frame.in_view = !(frame.box & view).empty();
  const Layer occluders = occludersAt(index);
  for (const cv::Point2d& point : frame.points) {
    frame.visible.push_back(view.contains(point) && occluders.coverageAt(point) < kHidden);
  }
  return frame;
}

cv::Mat3b ComposedScene::renderWithoutObject(int index) const { return takePicture(index, false); }

}  // namespace chain_tracker
