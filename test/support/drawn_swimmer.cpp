// SPDX-License-Identifier: BSD-3-Clause
#include "support/drawn_swimmer.h"

#include <cmath>

#include <opencv2/imgproc.hpp>

#include "chain_tracker/chain/chain_tracker.h"

namespace chain_tracker {
namespace {

constexpr int kEdges = 20;
constexpr int kFiner = 4;
constexpr double kLeastThickness = 5.0;

}  // namespace

cv::Mat3b clutteredGround(cv::RNG& random) {
  cv::Mat3b image(240, 400);
  random.fill(image, cv::RNG::NORMAL, cv::Scalar::all(170), cv::Scalar::all(12));
  cv::GaussianBlur(image, image, {}, 1.0);
  return image;
}

std::vector<cv::Point2d> DrawnSwimmer::midline(int frame) const {
  std::vector<cv::Point2d> line = {{60.0, 120.0}};
  for (int i = 0; i < kEdges; ++i) {
    const double along = (i + 0.5) / kEdges;
    const double most = bend_ * (1.0 - tail_ * (1.0 - along));
    const double angle = most * std::sin(2.0 * CV_PI * (along - frame / 30.0));
    line.push_back(line.back() + kLength / kEdges * cv::Point2d(std::cos(angle), std::sin(angle)));
  }
  return line;
}

double DrawnSwimmer::thicknessAt(double along) const {
  const double share = taper_ > 0.0 ? std::sin(CV_PI * std::pow(along, taper_)) : 1.0;
  return kLeastThickness + thickness_ * share;
}

cv::Mat3b DrawnSwimmer::image(int frame) {
  cv::Mat3b image = clutteredGround(random_);
  cv::resize(image, image, {}, kFiner, kFiner);
  const std::vector<cv::Point2d> line = midline(frame);
  for (size_t i = 1; i < line.size(); ++i) {
    const double thickness = thicknessAt(static_cast<double>(i) / kEdges);
    cv::line(image, line[i - 1] * kFiner, line[i] * kFiner, {50, 35, 30},
             cvRound(thickness * kFiner), cv::LINE_AA);
  }
  cv::resize(image, image, {}, 1.0 / kFiner, 1.0 / kFiner, cv::INTER_AREA);
  cv::Mat3b noise(image.size());
  random_.fill(noise, cv::RNG::NORMAL, cv::Scalar::all(20), cv::Scalar::all(4));
  cv::add(image, noise, image);
  return image;
}

double errorOfMidline(const ChainModel& model, DrawnSwimmer swimmer) {
  ChainTracker tracker(model, swimmer.image(0), swimmer.midline(0));
  double error = 0.0;
  int points = 0;
  for (int frame = 1; frame <= 120; ++frame) {
    const ChainState& state = tracker.update(swimmer.image(frame));
    const std::vector<cv::Point2d> truth = swimmer.midline(frame);
    for (size_t i = 0; i < truth.size(); ++i, ++points) {
      error += cv::norm(state.points[i].position - truth[i]);
    }
  }
  return error / points;
}

}  // namespace chain_tracker
