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

void FramePixels::show(const cv::Mat& image) {
  image_ = image;
  entries_.pixels.create(image.size());
  entries_.known.clear();
  grey_.known.clear();
  if (image.channels() == 3) {
    grey_.pixels.create(image.size());
  } else {
    grey_.pixels = image;
    grey_.known.emplace_back(cv::Point(), image.size());
  }
}

/// `compute` is given the part of the plane that is to be filled.
template <typename Compute>
void FramePixels::ensure(const cv::Rect& inside, PartialPlane& plane, const Compute& compute) {
  const auto holds = [&](const cv::Rect& known) { return contains(known, inside); };
  if (std::any_of(plane.known.begin(), plane.known.end(), holds)) return;
  cv::Mat1b target = plane.pixels(inside);
  compute(target);
  plane.known.push_back(inside);
}

cv::Mat1b FramePixels::entries(const cv::Rect& region) {
  const cv::Rect inside = region & cv::Rect(cv::Point(), image_.size());
  if (!inside.empty()) {
    ensure(inside, entries_, [&](cv::Mat1b& out) { palette_.classify(image_, inside, out); });
  }
  if (inside == region) return entries_.pixels(region);
  reuse(entries_.padded, region.size());
  entries_.padded.setTo(ColorPalette::kOther);
  if (!inside.empty()) {
    entries_.pixels(inside).copyTo(entries_.padded(inside - region.tl()));
  }
  return entries_.padded;
}

cv::Mat1b FramePixels::grey(const cv::Rect& region) {
  const cv::Rect inside = nearestPixels(region, image_.size());
  ensure(inside, grey_,
         [&](cv::Mat1b& out) { cv::cvtColor(image_(inside), out, cv::COLOR_BGR2GRAY); });
  if (inside == region) return grey_.pixels(region);
  const cv::Rect whole = region | inside;
  reuse(grey_.padded, whole.size());
  cv::copyMakeBorder(grey_.pixels(inside), grey_.padded, inside.y - whole.y,
                     whole.br().y - inside.br().y, inside.x - whole.x, whole.br().x - inside.br().x,
                     cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  return grey_.padded(region - whole.tl());
}

}  // namespace chain_tracker
