// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/haar/haar_feature.h"

#include <set>
#include <stdexcept>

namespace chain_tracker::haar {
namespace {

std::string textOf(const WeightedRectangle& r) {
  return "rectangle [" + std::to_string(r.x) + ", " + std::to_string(r.y) + ", " +
         std::to_string(r.width) + ", " + std::to_string(r.height) + ", " +
         std::to_string(r.weight) + "]";
}

std::string faultOf(const WeightedRectangle& r) {
  const std::string limit = std::to_string(kMaxExtent);
  if (r.width <= 0 || r.height <= 0) return textOf(r) + " has no area";
  if (r.width > kMaxExtent || r.height > kMaxExtent) {
    return textOf(r) + " is larger than " + limit + " px";
  }
  if (r.x < -kMaxExtent || r.x > kMaxExtent || r.y < -kMaxExtent || r.y > kMaxExtent) {
    return textOf(r) + " is further than " + limit + " px from the pixel of the response";
  }
  if (r.weight == 0) return textOf(r) + " has weight 0";
  if (r.weight < -kMaxWeight || r.weight > kMaxWeight) {
    return textOf(r) + " has a weight beyond " + std::to_string(kMaxWeight);
  }
  return "";
}

}  // namespace

cv::Rect HaarFeature::bounds() const {
  cv::Rect box;
  for (const WeightedRectangle& r : rectangles) box |= cv::Rect(r.x, r.y, r.width, r.height);
  return box;
}

std::string faultOf(const HaarFeature& feature) {
  if (feature.name.empty()) return "a feature has no name";
  const std::string place = "feature '" + feature.name + "': ";
  if (feature.rectangles.empty()) return place + "has no rectangles";
  if (feature.rectangles.size() > static_cast<size_t>(kMaxRectangles)) {
    return place + "has " + std::to_string(feature.rectangles.size()) +
           " rectangles, may have at most " + std::to_string(kMaxRectangles);
  }
  for (const WeightedRectangle& r : feature.rectangles) {
    const std::string fault = faultOf(r);
    if (!fault.empty()) return place + fault;
  }
  return "";
}

FeatureEnsemble::FeatureEnsemble(std::string name, std::vector<HaarFeature> features)
    : name_(std::move(name)), features_(std::move(features)) {
  if (features_.empty()) throw std::invalid_argument("ensemble '" + name_ + "' has no features");
  std::set<std::string> names;
  for (const HaarFeature& feature : features_) {
    const std::string fault = faultOf(feature);
    if (!fault.empty()) throw std::invalid_argument("ensemble '" + name_ + "': " + fault);
    if (!names.insert(feature.name).second) {
      throw std::invalid_argument("ensemble '" + name_ + "': feature '" + feature.name +
                                  "' is there twice");
    }
  }
}

}  // namespace chain_tracker::haar
