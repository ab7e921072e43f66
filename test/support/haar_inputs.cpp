// SPDX-License-Identifier: BSD-3-Clause
#include "support/haar_inputs.h"

#include <filesystem>

#include "chain_tracker/haar/double_difference.h"
#include "support/map_difference.h"

namespace chain_tracker {
namespace {

haar::WeightedRectangle randomRectangle(RandomInputs& random, int reach) {
  const int weight = random.integer(1, 3) * (random.integer(0, 1) == 0 ? 1 : -1);
  return {random.integer(-reach, reach), random.integer(-reach, reach), random.integer(1, reach),
          random.integer(1, reach), weight};
}

/// Shifted, and scaled by 1, 2, -1 or -2.
haar::HaarFeature alteredCopy(RandomInputs& random, haar::HaarFeature feature) {
  const int scale = random.integer(1, 2) * (random.integer(0, 1) == 0 ? 1 : -1);
  const cv::Point shift(random.integer(-3, 3), random.integer(-3, 3));
  for (haar::WeightedRectangle& r : feature.rectangles) {
    r.x += shift.x;
    r.y += shift.y;
    r.weight *= scale;
  }
  return feature;
}

}  // namespace

haar::FeatureEnsemble randomEnsemble(RandomInputs& random, int features, int reach) {
  std::vector<haar::HaarFeature> all;
  while (static_cast<int>(all.size()) < features) {
    haar::HaarFeature feature;
    if (!all.empty() && random.integer(0, 3) == 0) {
      feature = alteredCopy(
          random, all[static_cast<size_t>(random.integer(0, static_cast<int>(all.size()) - 1))]);
    } else {
      const int rectangles = random.integer(1, 4);
      for (int i = 0; i < rectangles; ++i) {
        feature.rectangles.push_back(randomRectangle(random, reach));
      }
    }
    feature.name = "f" + std::to_string(all.size());
    if (!haar::doubleDifference(feature).isZero()) all.push_back(feature);
  }
  return {"random", std::move(all)};
}

haar::FeatureEnsemble randomShapes(RandomInputs& random, int features, int reach) {
  std::vector<haar::HaarFeature> all;
  for (int i = 0; i < features; ++i) {
    const int width = random.integer(1, reach);
    const int height = random.integer(1, reach);
    const int cells = random.integer(1, 3);
    const bool across = random.integer(0, 1) == 0;
    const int weights[3][3] = {{1, 0, 0}, {-1, 1, 0}, {1, -2, 1}};
    haar::HaarFeature feature{"f" + std::to_string(i), {}};
    for (int cell = 0; cell < cells; ++cell) {
      feature.rectangles.push_back({across ? cell * width : 0, across ? 0 : cell * height, width,
                                    height, weights[cells - 1][cell]});
    }
    all.push_back(feature);
  }
  return {"shapes", std::move(all)};
}

std::string firstDifference(const std::vector<cv::Mat1i>& expected,
                            const std::vector<cv::Mat1i>& actual) {
  if (expected.size() != actual.size()) {
    return std::to_string(expected.size()) + " responses expected, " +
           std::to_string(actual.size()) + " are there";
  }
  for (size_t i = 0; i < expected.size(); ++i) {
    const std::string difference = firstDifference(expected[i], actual[i]);
    if (!difference.empty()) return "response " + std::to_string(i) + ": " + difference;
  }
  return "";
}

std::string cascadeFolder() {
  for (const char* folder : {"/usr/share/opencv4/haarcascades", "/usr/share/opencv/haarcascades"}) {
    if (std::filesystem::exists(folder)) return folder;
  }
  return "";
}

}  // namespace chain_tracker
