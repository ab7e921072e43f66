// SPDX-License-Identifier: BSD-3-Clause
/// Haar-like features: weighted sums of upright rectangles (thesis ch. 5).
///
/// The response of a feature at a pixel (x, y) is
///     sum over its rectangles r:  r.weight * sum of the pixels (x + r.x .. x + r.x + r.width - 1,
///                                                               y + r.y .. y + r.y + r.height - 1)
///
/// Border convention of the whole front end: every pixel of the image has a response, and pixels
/// outside the image count as zero. Where the feature lies inside the image entirely, the response
/// does not depend on that convention.
#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace chain_tracker::haar {

/// Largest size and offset of a rectangle [px].
constexpr int kMaxExtent = 4096;
/// Largest absolute weight of a rectangle.
constexpr int kMaxWeight = 65536;
/// Most rectangles in one feature.
constexpr int kMaxRectangles = 64;

struct WeightedRectangle {
  int x = 0;  ///< left column, relative to the pixel of the response
  int y = 0;  ///< top row, relative to the pixel of the response
  int width = 0;
  int height = 0;
  int weight = 0;
};

struct HaarFeature {
  std::string name;
  std::vector<WeightedRectangle> rectangles;

  /// The smallest box around all rectangles, relative to the pixel of the response.
  cv::Rect bounds() const;
};

/// The reason why a feature cannot be used; empty if it can: it needs a name, 1 to kMaxRectangles
/// rectangles of positive area within the limits above, and weights that are not zero.
std::string faultOf(const HaarFeature& feature);

/// Features that are computed together; their order is the order of the responses.
class FeatureEnsemble {
 public:
  /// Throws std::invalid_argument that names the first faulty or repeated feature, or says that
  /// there is none.
  FeatureEnsemble(std::string name, std::vector<HaarFeature> features);

  const std::string& name() const { return name_; }
  const std::vector<HaarFeature>& features() const { return features_; }
  size_t size() const { return features_.size(); }

 private:
  std::string name_;
  std::vector<HaarFeature> features_;
};

}  // namespace chain_tracker::haar
