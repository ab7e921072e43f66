// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/frame_pixels.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>

#include "reused_plane.h"

namespace chain_tracker {
namespace {

bool contains(const cv::Rect& outer, const cv::Rect& inner) { return (outer & inner) == inner; }

/// The image's pixels nearest to those of a region: at least one.
cv::Rect nearestPixels(const cv::Rect& region, const cv::Size& image) {
  const auto column = [&](int x) { return std::clamp(x, 0, image.width - 1); };
  const auto row = [&](int y) { return std::clamp(y, 0, image.height - 1); };
  const cv::Point first(column(region.x), row(region.y));
  const cv::Point last(column(region.br().x - 1), row(region.br().y - 1));
  return {first, last + cv::Point(1, 1)};
}

}  // namespace

void FramePixels::show(const cv::Mat& image, const ChannelGains& gains) {
  image_ = image;
  gains_ = gains;
  entries_.pixels.create(image.size());
  entries_.known.clear();
  edges_.pixels.create(image.size());
  edges_.known.clear();
  grey_.known.clear();
  if (image.channels() == 3) {
    grey_.pixels.create(image.size());
  } else {
    grey_.pixels = image;
    grey_.known.emplace_back(cv::Point(), image.size());
  }
}

/// `compute` is given the part of the plane that is to be filled, by its place and as a plane.
template <typename Compute>
void FramePixels::ensure(const cv::Rect& inside, PartialPlane& plane, const Compute& compute) {
  const auto holds = [&](const cv::Rect& known) { return contains(known, inside); };
  if (std::any_of(plane.known.begin(), plane.known.end(), holds)) return;
  cv::Mat1b target = plane.pixels(inside);
  compute(inside, target);
  plane.known.push_back(inside);
}

/// The same of a plane whose code outside the image is 0.
template <typename Compute>
cv::Mat1b FramePixels::zeroOutside(const cv::Rect& region, PartialPlane& plane,
                                   const Compute& compute) const {
  const cv::Rect inside = region & cv::Rect(cv::Point(), image_.size());
  if (!inside.empty()) ensure(inside, plane, compute);
  if (inside == region) return plane.pixels(region);
  reuse(plane.padded, region.size());
  fill(plane.padded, uchar(0));
  if (!inside.empty()) plane.pixels(inside).copyTo(plane.padded(inside - region.tl()));
  return plane.padded;
}

cv::Mat1b FramePixels::entries(const cv::Rect& region) {
  static_assert(ColorPalette::kOther == 0);
  return zeroOutside(region, entries_, [&](const cv::Rect& inside, cv::Mat1b& out) {
    palette_.classify(image_, inside, gains_, out);
  });
}

ObjectColor FramePixels::objectColor(const cv::Rect& region) {
  const cv::Rect inside = region & cv::Rect(cv::Point(), image_.size());
  if (inside.empty()) return {};
  const cv::Mat1b own = entries(inside);
  const cv::Scalar mean = cv::mean(image_(inside), own);
  return {static_cast<double>(cv::countNonZero(own)) / region.area(),
          image_.channels() == 3 ? cv::Vec3d(mean[0], mean[1], mean[2]) : cv::Vec3d::all(mean[0])};
}

cv::Mat1b FramePixels::edges(const cv::Rect& region) {
  static_assert(kNoEdge == 0);
  return zeroOutside(region, edges_, [&](const cv::Rect& inside, cv::Mat1b& out) {
    edge_directions_.compute(grey(EdgeDirections::neededFor(inside)), out);
  });
}

cv::Mat1b FramePixels::codes(Channel channel, const cv::Rect& region) {
  return channel == Channel::kColors ? entries(region) : edges(region);
}

int FramePixels::codeCount(Channel channel) const {
  return channel == Channel::kColors ? palette_.size() : kEdgeCodes;
}

cv::Mat1b FramePixels::grey(const cv::Rect& region) {
  const cv::Rect inside = nearestPixels(region, image_.size());
  ensure(inside, grey_, [&](const cv::Rect& part, cv::Mat1b& out) {
    cv::cvtColor(image_(part), out, cv::COLOR_BGR2GRAY);
  });
  if (inside == region) return grey_.pixels(region);
  const cv::Rect whole = region | inside;
  reuse(grey_.padded, whole.size());
  cv::copyMakeBorder(grey_.pixels(inside), grey_.padded, inside.y - whole.y,
                     whole.br().y - inside.br().y, inside.x - whole.x, whole.br().x - inside.br().x,
                     cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  return grey_.padded(region - whole.tl());
}

}  // namespace chain_tracker
