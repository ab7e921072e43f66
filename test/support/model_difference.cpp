// SPDX-License-Identifier: BSD-3-Clause
#include "support/model_difference.h"

#include <algorithm>
#include <sstream>

namespace chain_tracker {
namespace {

class Differences {
 public:
  template <typename Value>
  void compare(const std::string& key, const Value& expected, const Value& actual) {
    if (expected == actual) return;
    text_ << key << " is " << actual << ", expected " << expected << "\n";
  }

  void compare(const std::string& prefix, const SegmentModel& expected,
               const SegmentModel& actual) {
    compare(prefix + "name", expected.name, actual.name);
    compare(prefix + "layout", static_cast<int>(expected.layout), static_cast<int>(actual.layout));
    compare(prefix + "parts", expected.parts, actual.parts);
    compare(prefix + "aspect", expected.aspect, actual.aspect);
    compare(prefix + "measure_aspect", expected.measure_aspect, actual.measure_aspect);
    compare(prefix + "margin", expected.margin, actual.margin);
    compare(prefix + "window", expected.window, actual.window);
    compare(prefix + "measure_window", expected.measure_window, actual.measure_window);
    compare(prefix + "stretch_sigma", expected.stretch_sigma, actual.stretch_sigma);
    compare(prefix + "bend_sigma", expected.bend_sigma, actual.bend_sigma);
    compare(prefix + "shape_memory", expected.shape_memory, actual.shape_memory);
    compare(prefix + "orientation_hypotheses", expected.orientation_hypotheses,
            actual.orientation_hypotheses);
    compare(prefix + "orientation_step", expected.orientation_step, actual.orientation_step);
    compare(prefix + "orientation_sigma", expected.orientation_sigma, actual.orientation_sigma);
    compare(prefix + "scale_hypotheses", expected.scale_hypotheses, actual.scale_hypotheses);
    compare(prefix + "scale_step", expected.scale_step, actual.scale_step);
    compare(prefix + "scale_sigma", expected.scale_sigma, actual.scale_sigma);
  }

  void compare(const AppearanceModel& expected, const AppearanceModel& actual) {
    compare("appearance/palette_colors", expected.palette_colors, actual.palette_colors);
    compare("appearance/ring", expected.ring, actual.ring);
    compare("appearance/min_object_share", expected.min_object_share, actual.min_object_share);
    compare("appearance/weight", expected.weight, actual.weight);
    compare("appearance/edge_weight", expected.edge_weight, actual.edge_weight);
    compare("appearance/haar_weight", expected.haar_weight, actual.haar_weight);
    compare("appearance/outlier_below", expected.outlier_below, actual.outlier_below);
    compare("appearance/outlier_slope", expected.outlier_slope, actual.outlier_slope);
    compare("appearance/light_rate", expected.light_rate, actual.light_rate);
  }

  void compare(const SearchModel& expected, const SearchModel& actual) {
    compare("search/radius", expected.radius, actual.radius);
    compare("search/lost_below", expected.lost_below, actual.lost_below);
    compare("search/lost_share", expected.lost_share, actual.lost_share);
    compare("search/found_above", expected.found_above, actual.found_above);
    compare("search/occluded_below", expected.occluded_below, actual.occluded_below);
    compare("search/travel_weight", expected.travel_weight, actual.travel_weight);
    compare("search/doubt_below", expected.doubt_below, actual.doubt_below);
  }

  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
};

}  // namespace

std::string differencesOf(const ChainModel& expected, const ChainModel& actual) {
  Differences differences;
  differences.compare("name", expected.name, actual.name);
  differences.compare("number of segments", expected.segments.size(), actual.segments.size());
  for (size_t i = 0; i < std::min(expected.segments.size(), actual.segments.size()); ++i) {
    const std::string prefix = "segments[" + std::to_string(i) + "]/";
    differences.compare(prefix, expected.segments[i], actual.segments[i]);
  }
  differences.compare("segment_per_edge", expected.segment_per_edge, actual.segment_per_edge);
  differences.compare("number of joints", expected.joints.size(), actual.joints.size());
  for (size_t i = 0; i < std::min(expected.joints.size(), actual.joints.size()); ++i) {
    const std::string prefix = "joints[" + std::to_string(i) + "]/";
    differences.compare(prefix + "min_angle", expected.joints[i].min_angle,
                        actual.joints[i].min_angle);
    differences.compare(prefix + "max_angle", expected.joints[i].max_angle,
                        actual.joints[i].max_angle);
  }
  differences.compare(expected.appearance, actual.appearance);
  differences.compare(expected.search, actual.search);
  return differences.text();
}

}  // namespace chain_tracker
