// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/haar/shipped_ensembles.h"

#include <stdexcept>

namespace chain_tracker::haar {
namespace {

HaarFeature transposed(const HaarFeature& feature, const std::string& name) {
  HaarFeature result{name, feature.rectangles};
  for (WeightedRectangle& r : result.rectangles) {
    std::swap(r.x, r.y);
    std::swap(r.width, r.height);
  }
  return result;
}

HaarFeature surfDyy(int lobe, const std::string& name) {
  const int width = 2 * lobe - 1;
  const int left = -(lobe - 1);
  const int middle_top = -(lobe / 2);
  return {name,
          {{left, middle_top - lobe, width, 3 * lobe, 1}, {left, middle_top, width, lobe, -3}}};
}

HaarFeature surfDxy(int lobe, const std::string& name) {
  return {name,
          {{-lobe, -lobe, lobe, lobe, 1},
           {1, -lobe, lobe, lobe, -1},
           {-lobe, 1, lobe, lobe, -1},
           {1, 1, lobe, lobe, 1}}};
}

/// A row of square cells with these weights.
HaarFeature cellRow(int side, const std::vector<int>& weights, const std::string& name) {
  HaarFeature feature{name, {}};
  for (size_t i = 0; i < weights.size(); ++i) {
    feature.rectangles.push_back({static_cast<int>(i) * side, 0, side, side, weights[i]});
  }
  return feature;
}

}  // namespace

FeatureEnsemble surfEnsemble(int octave) {
  if (octave < 1 || octave > 4) {
    throw std::invalid_argument("SURF has octaves 1 to 4, not " + std::to_string(octave));
  }
  const int step = 6 << (octave - 1);
  const int first = step + 3;
  std::vector<HaarFeature> features;
  for (int size = first; size <= first + 3 * step; size += step) {
    const std::string suffix = "_" + std::to_string(size);
    const HaarFeature dyy = surfDyy(size / 3, "dyy" + suffix);
    features.push_back(transposed(dyy, "dxx" + suffix));
    features.push_back(dyy);
    features.push_back(surfDxy(size / 3, "dxy" + suffix));
  }
  return {octave == 1 ? "surf" : "surf" + std::to_string(octave), std::move(features)};
}

FeatureEnsemble violaJonesEnsemble() {
  std::vector<HaarFeature> features;
  for (const int side : {2, 3, 4, 6, 8}) {
    const std::string suffix = "_" + std::to_string(side);
    const HaarFeature edge = cellRow(side, {-1, 1}, "edge_x" + suffix);
    const HaarFeature bar = cellRow(side, {1, -2, 1}, "bar_x" + suffix);
    features.push_back(edge);
    features.push_back(transposed(edge, "edge_y" + suffix));
    features.push_back(bar);
    features.push_back(transposed(bar, "bar_y" + suffix));
    features.push_back({"checker" + suffix,
                        {{0, 0, side, side, 1},
                         {side, 0, side, side, -1},
                         {0, side, side, side, -1},
                         {side, side, side, side, 1}}});
  }
  return {"viola_jones", std::move(features)};
}

FeatureEnsemble boxEnsemble(const cv::Size& window) {
  const HaarFeature box{"box", {{0, 0, window.width, window.height, 1}}};
  return {"box", {box}};
}

std::vector<std::string> shippedEnsembleNames() {
  return {"surf", "surf2", "surf3", "surf4", "viola_jones"};
}

FeatureEnsemble shippedEnsemble(const std::string& name) {
  if (name == "viola_jones") return violaJonesEnsemble();
  const std::vector<std::string> names = shippedEnsembleNames();
  for (int octave = 1; octave <= 4; ++octave) {
    if (name == names[static_cast<size_t>(octave - 1)]) return surfEnsemble(octave);
  }
  throw std::invalid_argument("there is no ensemble '" + name + "'");
}

}  // namespace chain_tracker::haar
