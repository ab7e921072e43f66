// SPDX-License-Identifier: BSD-3-Clause
#include "support/random_inputs.h"

#include <limits>

namespace chain_tracker {

cv::Mat1f RandomInputs::costs(const cv::Size& size, double forbidden) {
  cv::Mat1f map(size);
  for (float& value : map) {
    value = cost();
    if (real(0.0, 1.0) < forbidden) value = std::numeric_limits<float>::infinity();
  }
  return map;
}

std::vector<cv::Mat1f> RandomInputs::costMaps(size_t count, const cv::Size& size,
                                              double forbidden) {
  std::vector<cv::Mat1f> maps;
  for (size_t i = 0; i < count; ++i) maps.push_back(costs(size, forbidden));
  return maps;
}

EdgeStencil RandomInputs::stencil(int offsets, int reach) {
  EdgeStencil stencil;
  for (int i = 0; i < offsets; ++i) {
    stencil.push_back({integer(-reach, reach), integer(-reach, reach), cost()});
  }
  return stencil;
}

std::vector<cv::Point2d> RandomInputs::points(size_t count, double low, double high) {
  std::vector<cv::Point2d> points;
  for (size_t i = 0; i < count; ++i) points.push_back(point(low, high));
  return points;
}

cv::Mat RandomInputs::noise(const cv::Size& size, int type) {
  cv::Mat image(size, type);
  generator_.fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

}  // namespace chain_tracker
