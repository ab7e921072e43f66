// SPDX-License-Identifier: BSD-3-Clause
/// OpenCV's trackers behind one interface. Their classes moved in OpenCV 4.5.1: MIL to the video
/// module, KCF and CSRT to integer boxes, MedianFlow to the namespace legacy.
#include <cstdlib>
#include <functional>
#include <map>
#include <stdexcept>
#include <utility>

#include <opencv2/core/version.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#if __has_include(<opencv2/tracking.hpp>)
#include <opencv2/tracking.hpp>
#define CHAIN_TRACKER_HAS_CONTRIB 1
#else
#define CHAIN_TRACKER_HAS_CONTRIB 0
#endif
#if __has_include(<opencv2/tracking/tracking_legacy.hpp>)
#include <opencv2/tracking/tracking_legacy.hpp>
namespace cv_median_flow = cv::legacy;
#else
namespace cv_median_flow = cv;
#endif

#include "chain_tracker/evaluation/evaluated_tracker.h"

namespace chain_tracker {
namespace {

/// As int() does in the scripts that drive these trackers elsewhere.
cv::Rect wholePixels(const cv::Rect2d& box) {
  return {static_cast<int>(box.x), static_cast<int>(box.y), static_cast<int>(box.width),
          static_cast<int>(box.height)};
}

cv::Rect insideOf(const cv::Mat& image, const cv::Rect& box) {
  return box & cv::Rect(cv::Point(), image.size());
}

TrackedFrame reportBox(bool found, const cv::Rect2d& box, double first_width) {
  TrackedFrame frame;
  frame.state = found ? "TRACKING" : "LOST";
  frame.confidence = found ? 1.0 : 0.0;
  frame.lost = !found;
  frame.box = box;
  frame.scale = box.width / first_width;
  return frame;
}

/// A tracker of OpenCV's, whose boxes are whole pixels or not.
template <typename Tracker, typename Box>
class OpenCvTracker : public EvaluatedTracker {
 public:
  OpenCvTracker(std::string name, std::function<cv::Ptr<Tracker>()> create, const cv::Rect& box)
      : name_(std::move(name)), create_(std::move(create)), first_box_(box), box_(box) {}

  std::string name() const override { return name_; }

  TrackedFrame start(const cv::Mat& image) override {
    // MIL draws its features from the one and its samples from the other: give it what a program of
    // its own would start with.
    std::srand(1);
    cv::theRNG() = cv::RNG();
    tracker_ = create_();
    tracker_->init(image, insideOf(image, first_box_));
    return reportBox(true, first_box_, first_box_.width);
  }

  TrackedFrame update(const cv::Mat& image) override {
    const bool found = tracker_->update(image, box_);
    return reportBox(found, box_, first_box_.width);
  }

 private:
  std::string name_;
  std::function<cv::Ptr<Tracker>()> create_;
  cv::Rect first_box_;
  Box box_;
  cv::Ptr<Tracker> tracker_;
};

/// Mean shift on the back-projected hue histogram, as in OpenCV's own demonstration.
class CamShiftTracker : public EvaluatedTracker {
 public:
  explicit CamShiftTracker(const cv::Rect& box) : first_box_(box), window_(box) {}

  std::string name() const override { return "camshift"; }

  TrackedFrame start(const cv::Mat& image) override {
    const cv::Rect inside = insideOf(image, first_box_);
    const auto [hue, mask] = hueOf(image);
    const int bins[] = {kBins};
    const int channels[] = {0};
    const cv::Mat region = hue(inside);
    cv::calcHist(&region, 1, channels, mask(inside), histogram_, 1, bins, ranges());
    cv::normalize(histogram_, histogram_, 0, 255, cv::NORM_MINMAX);
    window_ = inside;
    return reportBox(true, first_box_, first_box_.width);
  }

  TrackedFrame update(const cv::Mat& image) override {
    const auto [hue, mask] = hueOf(image);
    const int channels[] = {0};
    cv::Mat likelihood;
    cv::calcBackProject(&hue, 1, channels, histogram_, likelihood, ranges());
    likelihood &= mask;
    const cv::TermCriteria criteria(cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 10, 1);
    const cv::RotatedRect found = cv::CamShift(likelihood, window_, criteria);
    if (window_.area() > 1) return reportBox(true, found.boundingRect2f(), first_box_.width);
    window_ = cv::Rect(0, 0, image.cols, image.rows);  // as the demonstration recovers
    return reportBox(false, cv::Rect2d(), first_box_.width);
  }

 private:
  static constexpr int kBins = 16;

  static const float** ranges() {
    static const float kHueRange[] = {0.0F, 180.0F};
    static const float* ranges_of_channels[] = {kHueRange};
    return ranges_of_channels;
  }

  static std::pair<cv::Mat, cv::Mat> hueOf(const cv::Mat& image) {
    cv::Mat color = image;
    if (image.channels() == 1) cv::cvtColor(image, color, cv::COLOR_GRAY2BGR);
    cv::Mat hsv;
    cv::cvtColor(color, hsv, cv::COLOR_BGR2HSV);
    cv::Mat mask;
    cv::inRange(hsv, cv::Scalar(0, 30, 10), cv::Scalar(180, 256, 256), mask);
    cv::Mat hue;
    cv::extractChannel(hsv, hue, 0);
    return {hue, mask};
  }

  cv::Rect first_box_;
  cv::Rect window_;
  cv::Mat histogram_;
};

using Factory = std::function<std::unique_ptr<EvaluatedTracker>(const cv::Rect&)>;

template <typename Tracker, typename Box>
Factory factoryOf(const std::string& name) {
  return [name](const cv::Rect& box) {
    return std::make_unique<OpenCvTracker<Tracker, Box>>(
        name, [] { return Tracker::create(); }, box);
  };
}

const std::map<std::string, Factory>& factories() {
#if CV_VERSION_MAJOR * 10000 + CV_VERSION_MINOR * 100 + CV_VERSION_REVISION >= 40501
  using Box = cv::Rect;
#else
  using Box = cv::Rect2d;
#endif
  static const std::map<std::string, Factory> kAll = {
    {"camshift", [](const cv::Rect& box) { return std::make_unique<CamShiftTracker>(box); }},
    {"mil", factoryOf<cv::TrackerMIL, Box>("mil")},
#if CHAIN_TRACKER_HAS_CONTRIB
    {"kcf", factoryOf<cv::TrackerKCF, Box>("kcf")},
    {"csrt", factoryOf<cv::TrackerCSRT, Box>("csrt")},
    {"medianflow", factoryOf<cv_median_flow::TrackerMedianFlow, cv::Rect2d>("medianflow")},
#endif
  };
  return kAll;
}

}  // namespace

std::vector<std::string> baselineNames() {
  std::vector<std::string> names;
  for (const auto& factory : factories()) names.push_back(factory.first);
  return names;
}

std::unique_ptr<EvaluatedTracker> makeBaseline(const std::string& name, const cv::Rect2d& box) {
  const auto factory = factories().find(name);
  if (factory != factories().end()) return factory->second(wholePixels(box));
  std::string names;
  for (const std::string& known : baselineNames()) names += (names.empty() ? "" : ", ") + known;
  throw std::invalid_argument(
      "baseline is '" + name + "', must be one of: " + names +
      (CHAIN_TRACKER_HAS_CONTRIB ? "" : " (OpenCV was built without its contributed trackers)"));
}

}  // namespace chain_tracker
