// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/target_checks.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string>

namespace chain_tracker {
namespace {

/// Of the surroundings, to each side, of the size of the target.
constexpr double kSurroundings = 0.5;
/// Of the lightest and the darkest pixel, in one of the channels [grey levels]: less is noise.
constexpr double kLeastContrast = 8.0;

double largestSide(const cv::Size& image_size) {
  return std::min(image_size.width, image_size.height);
}

/// Bounds first: a mask of what lies far away would not fit into memory. They may cover an image
/// that a line passes round.
bool isHalfInside(const Silhouette& silhouette, const cv::Rect2d& bounds,
                  const cv::Size& image_size) {
  const cv::Rect2d area(-0.5, -0.5, image_size.width, image_size.height);
  const cv::Rect2d grown(bounds.x - 0.5, bounds.y - 0.5, bounds.width + 1.0, bounds.height + 1.0);
  if ((grown & area).area() < 0.5 * grown.area()) return false;
  const cv::Rect image(cv::Point(), image_size);
  const cv::Rect all = image | cv::Rect(cv::Point(grown.tl()), cv::Point(grown.br()));
  const cv::Mat1b mask = maskOf(silhouette, all, 0.0);
  const int inside = cv::countNonZero(mask(image - all.tl()));
  return inside > 0 && 2 * inside >= cv::countNonZero(mask);
}

bool hasPartsRoom(const SegmentLayout& segment, const cv::Size& image_size) {
  const double side = segment.parts.front().side;
  return side >= kSmallestSide && side <= largestSide(image_size);
}

}  // namespace

std::string textOf(const cv::Size& size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

void requireModel(const ChainModel& model) {
  std::string message;
  for (const std::string& fault : faultsOf(model)) {
    message += (message.empty() ? "model " + model.name + ": " : "; ") + fault;
  }
  if (!message.empty()) throw std::invalid_argument(message);
}

void requireImage(const cv::Mat& image) {
  if (image.empty()) throw std::invalid_argument("the image is empty");
  if (image.type() == CV_8UC3 || image.type() == CV_8UC1) return;
  throw std::invalid_argument("the image's type is " + cv::typeToString(image.type()) +
                              ", must be CV_8UC3 or CV_8UC1");
}

void requireSameKind(const cv::Mat& image, const cv::Size& first_size, int first_type) {
  requireImage(image);
  if (image.size() == first_size && image.type() == first_type) return;
  throw std::invalid_argument("the image is " + textOf(image.size()) + " " +
                              cv::typeToString(image.type()) + ", must be " + textOf(first_size) +
                              " " + cv::typeToString(first_type) + " as at initialisation");
}

void requireThreads(int threads) {
  if (threads >= 1 && threads <= kMostThreads) return;
  throw std::invalid_argument("threads is " + std::to_string(threads) + ", must be in [1, " +
                              std::to_string(kMostThreads) + "]");
}

void requirePartsFit(const ChainLayout& layout, const cv::Size& image_size) {
  for (const SegmentLayout& segment : layout.segments) {
    if (hasPartsRoom(segment, image_size)) continue;
    std::ostringstream message;
    message << "the " << segment.parts.size() << " parts of segment " << segment.name << " are "
            << segment.parts.front().side << " px wide, must be from " << kSmallestSide << " to "
            << largestSide(image_size) << " px, the shorter side of the " << textOf(image_size)
            << " image";
    throw std::invalid_argument(message.str());
  }
}

bool havePartsRoom(const ChainLayout& layout, const cv::Size& image_size) {
  return std::all_of(
      layout.segments.begin(), layout.segments.end(),
      [&](const SegmentLayout& segment) { return hasPartsRoom(segment, image_size); });
}

void requireInside(const Silhouette& silhouette, const cv::Size& image_size) {
  const cv::Rect2d bounds = uprightBounds(silhouette.points);
  if (isHalfInside(silhouette, bounds, image_size)) return;
  std::ostringstream message;
  message << "the target spans x " << bounds.x << " to " << bounds.br().x << " and y " << bounds.y
          << " to " << bounds.br().y << " px, must lie at least half inside the "
          << textOf(image_size) << " image";
  throw std::invalid_argument(message.str());
}

void requireContrast(const cv::Mat& image, const Silhouette& silhouette) {
  const cv::Rect2d bounds = uprightBounds(silhouette.points);
  const double reach = kSurroundings * std::max(bounds.width, bounds.height) + 1.0;
  const cv::Rect surroundings = cv::Rect(cv::Point(bounds.tl() - cv::Point2d(reach, reach)),
                                         cv::Point(bounds.br() + cv::Point2d(reach, reach))) &
                                cv::Rect(cv::Point(), image.size());
  std::vector<cv::Mat> channels;
  cv::split(image(surroundings), channels);
  double contrast = 0.0;
  for (const cv::Mat& channel : channels) {
    double darkest = 0.0;
    double lightest = 0.0;
    cv::minMaxLoc(channel, &darkest, &lightest);
    contrast = std::max(contrast, lightest - darkest);
  }
  if (contrast >= kLeastContrast) return;
  std::ostringstream message;
  message << "the image shows nothing to follow at the target: in " << textOf(surroundings.size())
          << " px around it the lightest and the darkest pixel differ by " << contrast
          << " of 255 grey levels, must differ by at least " << kLeastContrast;
  throw NothingToSee(message.str());
}

}  // namespace chain_tracker
