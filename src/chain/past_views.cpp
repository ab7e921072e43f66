// SPDX-License-Identifier: BSD-3-Clause
#include "past_views.h"

#include <algorithm>
#include <cmath>

namespace chain_tracker {
namespace {

/// Calls from one view to the next.
constexpr int kCallsPerView = 5;
/// Root mean square difference of the channels in a window that still shows the same: noise [grey
/// levels]. Squares, as what is thin differs from the ground in few pixels, but by much.
constexpr double kSame = 15.0;
/// Of a part's window, that is compared: its border may show something else.
constexpr double kMiddle = 0.7;
/// Share of a chain's parts.
constexpr double kMost = 0.6;

/// Whether no part of the object touched the window of `part`.
bool isAway(const PartState& part, const ChainState& object) {
  return std::none_of(object.parts.begin(), object.parts.end(), [&](const PartState& other) {
    return cv::norm(other.position - part.position) <= 0.5 * (other.side + part.side);
  });
}

cv::Rect middleOf(const PartState& part) {
  const int side = std::max(2, static_cast<int>(kMiddle * part.side));
  return {cvRound(part.position.x) - side / 2, cvRound(part.position.y) - side / 2, side, side};
}

bool areSame(const cv::Mat& a, const cv::Mat& b, const cv::Rect& window) {
  if (window.empty()) return false;
  const double values = static_cast<double>(window.area()) * a.channels();
  return cv::norm(a(window), b(window), cv::NORM_L2) <= kSame * std::sqrt(values);
}

}  // namespace

void PastViews::remember(const cv::Mat& image, const ChainState& object) {
  if (calls_++ % kCallsPerView != 0) return;
  View& view = first_.image.empty() ? first_ : latest_;
  image.copyTo(view.image);
  view.object = object;
}

bool PastViews::showed(const ChainState& chain, const cv::Mat& image) const {
  // Where it was at first for certain, and looks as it did: there it stands again.
  if (shows(first_, true, chain, image)) return false;
  return shows(first_, false, chain, image) || shows(latest_, false, chain, image);
}

/// `as_object`: what the object covered then, else what lay beside it.
bool PastViews::shows(const View& view, bool as_object, const ChainState& chain,
                      const cv::Mat& image) {
  if (view.image.empty()) return false;
  const cv::Rect bounds(cv::Point(), image.size());
  const auto standing =
      std::count_if(chain.parts.begin(), chain.parts.end(), [&](const PartState& part) {
        return isAway(part, view.object) != as_object &&
               areSame(image, view.image, middleOf(part) & bounds);
      });
  return static_cast<double>(standing) >= kMost * static_cast<double>(chain.parts.size());
}

}  // namespace chain_tracker
