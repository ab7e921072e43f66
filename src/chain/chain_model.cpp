// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/chain_model.h"

#include <algorithm>
#include <sstream>

namespace chain_tracker {
namespace {

constexpr size_t kMostSegments = 32;

class FaultList {
 public:
  template <typename Number>
  void requireRange(const std::string& key, Number value, Number low, Number high) {
    if (value >= low && value <= high) return;  // also refuses NaN
    std::ostringstream fault;
    fault << key << " is " << value << ", must be in [" << low << ", " << high << "]";
    faults_.push_back(fault.str());
  }

  void requireOdd(const std::string& key, int value) {
    if (value % 2 != 0) return;
    add(key + " is " + std::to_string(value) + ", must be odd (the middle one is no change)");
  }

  void requireText(const std::string& key, const std::string& value) {
    if (value.empty()) add(key + " is empty, must be a name");
  }

  void add(std::string fault) { faults_.push_back(std::move(fault)); }
  std::vector<std::string> take() { return std::move(faults_); }

 private:
  std::vector<std::string> faults_;
};

void checkSegment(const SegmentModel& segment, const std::string& prefix, FaultList& faults) {
  faults.requireText(prefix + "name", segment.name);
  faults.requireRange(prefix + "parts", segment.parts, 2, 200);
  faults.requireRange(prefix + "aspect", segment.aspect, 0.001, 1.0);
  faults.requireRange(prefix + "margin", segment.margin, 0.0, 1.0);
  faults.requireRange(prefix + "window", segment.window, 0.2, 10.0);
  if (segment.measure_window && segment.layout != Layout::kDeformable) {
    faults.add(prefix + "measure_window is true, must be false unless layout is deformable");
  }
  faults.requireRange(prefix + "stretch_sigma", segment.stretch_sigma, 0.005, 1.0);
  faults.requireRange(prefix + "bend_sigma", segment.bend_sigma, 0.005, 3.0);
  faults.requireRange(prefix + "shape_memory", segment.shape_memory, 0.0, 1.0);
  faults.requireRange(prefix + "orientation_hypotheses", segment.orientation_hypotheses, 1, 63);
  faults.requireOdd(prefix + "orientation_hypotheses", segment.orientation_hypotheses);
  faults.requireRange(prefix + "orientation_step", segment.orientation_step, 0.005, 1.0);
  faults.requireRange(prefix + "orientation_sigma", segment.orientation_sigma, 0.005, 10.0);
  faults.requireRange(prefix + "scale_hypotheses", segment.scale_hypotheses, 1, 15);
  faults.requireOdd(prefix + "scale_hypotheses", segment.scale_hypotheses);
  faults.requireRange(prefix + "scale_step", segment.scale_step, 0.002, 0.5);
  faults.requireRange(prefix + "scale_sigma", segment.scale_sigma, 0.002, 10.0);
}

void checkJoints(const ChainModel& model, FaultList& faults) {
  const size_t wanted = model.segments.size() - std::min<size_t>(1, model.segments.size());
  if (!model.joints.empty() && model.joints.size() != wanted) {
    faults.add("joints has " + std::to_string(model.joints.size()) +
               " entries, must have none or one fewer than segments: " + std::to_string(wanted));
  }
  for (size_t i = 0; i < model.joints.size(); ++i) {
    const std::string prefix = "joints[" + std::to_string(i) + "]/";
    const JointModel& joint = model.joints[i];
    faults.requireRange(prefix + "min_angle", joint.min_angle, -kFreeJoint, kFreeJoint);
    faults.requireRange(prefix + "max_angle", joint.max_angle, joint.min_angle, kFreeJoint);
  }
  if (model.segment_per_edge && model.segments.size() != 1) {
    faults.add("segments has " + std::to_string(model.segments.size()) +
               " entries, must have 1 where segment_per_edge is true");
  }
  if (model.segments.size() < 2 && !model.segment_per_edge) return;
  for (size_t i = 0; i < model.segments.size(); ++i) {
    const Layout layout = model.segments[i].layout;
    if (layout != Layout::kPlanar && layout != Layout::kPoints) continue;
    faults.add("segments[" + std::to_string(i) + "]/layout is " +
               (layout == Layout::kPlanar ? "planar" : "points") +
               ", must be elongated or deformable where segments are joined");
  }
}

void checkAppearance(const AppearanceModel& appearance, FaultList& faults) {
  faults.requireRange("appearance/palette_colors", appearance.palette_colors, 2, 254);
  faults.requireRange("appearance/ring", appearance.ring, 0.05, 3.0);
  faults.requireRange("appearance/min_object_share", appearance.min_object_share, 0.0, 0.95);
  faults.requireRange("appearance/weight", appearance.weight, 0.1, 1000.0);
  faults.requireRange("appearance/edge_weight", appearance.edge_weight, 0.0, 1000.0);
  faults.requireRange("appearance/haar_weight", appearance.haar_weight, 0.0, 1000.0);
  faults.requireRange("appearance/outlier_below", appearance.outlier_below, 0.0, 1.0);
  faults.requireRange("appearance/outlier_slope", appearance.outlier_slope, 0.0, 1.0);
  faults.requireRange("appearance/light_rate", appearance.light_rate, 0.0, 1.0);
}

void checkSearch(const SearchModel& search, FaultList& faults) {
  faults.requireRange("search/radius", search.radius, 0.002, 1.0);
  faults.requireRange("search/lost_below", search.lost_below, 0.0, 1.0);
  faults.requireRange("search/found_above", search.found_above, 0.0, 1.0);
  faults.requireRange("search/lost_share", search.lost_share, 0.0, 0.8);
  faults.requireRange("search/occluded_below", search.occluded_below, 0.0, 1.0);
  faults.requireRange("search/travel_weight", search.travel_weight, 0.0, 100.0);
  faults.requireRange("search/doubt_below", search.doubt_below, 0.0, 1.0);
  if (search.found_above < search.lost_below) {
    std::ostringstream fault;
    fault << "search/found_above is " << search.found_above
          << ", must not be below search/lost_below, which is " << search.lost_below;
    faults.add(fault.str());
  }
}

}  // namespace

ChainModel forPolyline(ChainModel model, size_t points) {
  if (!model.segment_per_edge || points < 2) return model;
  const SegmentModel segment = model.segments.front();
  model.segments.assign(points - 1, segment);
  for (size_t i = 0; i < model.segments.size(); ++i) {
    model.segments[i].name += std::to_string(i + 1);
  }
  model.segment_per_edge = false;
  return model;
}

JointModel jointOf(const ChainModel& model, size_t segment) {
  return model.joints.empty() ? JointModel() : model.joints[segment];
}

std::vector<std::string> faultsOf(const ChainModel& model) {
  FaultList faults;
  faults.requireText("name", model.name);
  if (model.segments.empty() || model.segments.size() > kMostSegments) {
    faults.add("segments has " + std::to_string(model.segments.size()) +
               " entries, must have 1 to " + std::to_string(kMostSegments));
  }
  for (size_t i = 0; i < model.segments.size(); ++i) {
    checkSegment(model.segments[i], "segments[" + std::to_string(i) + "]/", faults);
  }
  checkJoints(model, faults);
  checkAppearance(model.appearance, faults);
  checkSearch(model.search, faults);
  return faults.take();
}

}  // namespace chain_tracker
