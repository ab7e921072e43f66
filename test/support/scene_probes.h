// SPDX-License-Identifier: BSD-3-Clause
/// What tests measure in rendered pictures.
#pragma once

#include <cmath>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "chain_tracker/evaluation/synthetic_scene.h"

namespace chain_tracker {

/// Small, without noise, blur and shadow: what changes in the picture is the object.
inline SceneOptions cleanSceneOptions() {
  SceneOptions options;
  options.size = {320, 240};
  options.noise = 0.0;
  options.blur = 0.0;
  options.shadow = 0.0;
  return options;
}

inline bool samePicture(const cv::Mat3b& a, const cv::Mat3b& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

/// 255 where the pictures differ by more than `levels` in a channel.
inline cv::Mat1b changedPixels(const cv::Mat3b& a, const cv::Mat3b& b, double levels = 6.0) {
  cv::Mat difference;
  cv::absdiff(a, b, difference);
  cv::Mat1b mask(a.size(), uchar(0));
  for (int row = 0; row < mask.rows; ++row) {
    for (int x = 0; x < mask.cols; ++x) {
      const cv::Vec3b& pixel = difference.at<cv::Vec3b>(row, x);
      if (pixel[0] > levels || pixel[1] > levels || pixel[2] > levels) mask(row, x) = 255;
    }
  }
  return mask;
}

/// Where the object is seen in the frame.
inline cv::Mat1b objectMask(const SyntheticScene& scene, int index) {
  return changedPixels(scene.render(index).image, scene.renderWithoutObject(index));
}

/// Whether the mask is set within `radius` px of the point.
inline bool isSetNear(const cv::Mat1b& mask, const cv::Point2d& point, int radius) {
  const cv::Rect window(cvRound(point.x) - radius, cvRound(point.y) - radius, 2 * radius + 1,
                        2 * radius + 1);
  const cv::Rect seen = window & cv::Rect(cv::Point(), mask.size());
  return !seen.empty() && cv::countNonZero(mask(seen)) > 0;
}

/// Length of the mask along a direction [px].
inline double extentAlong(const cv::Mat1b& mask, const cv::Point2d& direction) {
  double low = 1e9;
  double high = -1e9;
  for (int row = 0; row < mask.rows; ++row) {
    for (int x = 0; x < mask.cols; ++x) {
      if (mask(row, x) == 0) continue;
      const double along = direction.dot(cv::Point2d(x, row));
      low = std::min(low, along);
      high = std::max(high, along);
    }
  }
  return high - low;
}

/// Centre of the mask and direction of its longer axis, the latter up to half turns.
struct MaskPose {
  cv::Point2d center;
  double direction = 0.0;
};

inline MaskPose poseOf(const cv::Mat1b& mask) {
  std::vector<cv::Point> pixels;
  cv::findNonZero(mask, pixels);
  cv::Point2d center;
  for (const cv::Point& pixel : pixels) center += cv::Point2d(pixel);
  center /= static_cast<double>(pixels.size());
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (const cv::Point& pixel : pixels) {
    const cv::Point2d offset = cv::Point2d(pixel) - center;
    xx += offset.x * offset.x;
    xy += offset.x * offset.y;
    yy += offset.y * offset.y;
  }
  return {center, 0.5 * std::atan2(2.0 * xy, xx - yy)};
}

}  // namespace chain_tracker
