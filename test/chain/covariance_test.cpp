// SPDX-License-Identifier: BSD-3-Clause
/// Whether the covariances mean what they say: how many true positions of visible parts lie inside
/// their 95 % ellipses, on rendered scenes.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "chain_tracker/chain/auto_model.h"
#include "chain_tracker/chain/chain_model_io.h"
#include "chain_tracker/chain/chain_tracker.h"
#include "chain_tracker/evaluation/synthetic_scene.h"

namespace chain_tracker {
namespace {

constexpr int kFrames = 120;
/// Squared Mahalanobis distance within which 95 % of a plane Gaussian lie.
constexpr double kNinetyFivePercent = 5.991;

/// A place on the polyline of a scene's points.
struct PolylinePlace {
  size_t edge = 0;
  double share = 0.0;  ///< of the edge

  cv::Point2d on(const std::vector<cv::Point2d>& points) const {
    return points[edge] + share * (points[edge + 1] - points[edge]);
  }
};

PolylinePlace nearestPlace(const std::vector<cv::Point2d>& points, const cv::Point2d& position) {
  PolylinePlace nearest;
  double least = std::numeric_limits<double>::infinity();
  for (size_t edge = 0; edge + 1 < points.size(); ++edge) {
    const cv::Point2d along = points[edge + 1] - points[edge];
    const double share = (position - points[edge]).dot(along) / along.dot(along);
    const PolylinePlace place{edge, std::clamp(share, 0.0, 1.0)};
    const double distance = cv::norm(place.on(points) - position);
    if (distance >= least) continue;
    least = distance;
    nearest = place;
  }
  return nearest;
}

/// Where the parts of the first frame are in another one: carried by the true pose of their rigid
/// segment, or by the polyline of a deformable object.
class TrueParts {
 public:
  TrueParts(const SceneFrame& first, const ChainState& state, bool is_deformable)
      : is_deformable_(is_deformable) {
    for (size_t m = 0; m < state.segments.size(); ++m) {
      const SegmentState& segment = state.segments[m];
      for (int k = segment.first_part; k < segment.first_part + segment.part_count; ++k) {
        const cv::Point2d position = state.parts[static_cast<size_t>(k)].position;
        segments_.push_back(m);
        in_segment_.push_back(first.segments[m].applyInverse(position));
        places_.push_back(nearestPlace(first.points, position));
      }
    }
  }

  cv::Point2d at(const SceneFrame& frame, size_t part) const {
    if (is_deformable_) return places_[part].on(frame.points);
    return frame.segments[segments_[part]].apply(in_segment_[part]);
  }

 private:
  bool is_deformable_;
  std::vector<size_t> segments_;
  std::vector<cv::Point2d> in_segment_;
  std::vector<PolylinePlace> places_;
};

bool isInside(const PartState& part, const cv::Point2d& truth) {
  const cv::Vec2d error(part.position.x - truth.x, part.position.y - truth.y);
  return error.dot(part.covariance.inv() * error) <= kNinetyFivePercent;
}

/// Of the visible parts whose covariance is known, in all frames.
double shareInside(const std::string& scene_name) {
  const auto scene = makeScene(scene_name, SceneOptions());
  const SceneFrame first = scene->render(0);
  const std::string name = scene->model() == "auto" ? autoModelName(first.points) : scene->model();
  const ChainModel model =
      loadChainModel(std::string(CHAIN_TRACKER_SOURCE_DIR) + "/config/models/" + name + ".yaml");
  ChainTracker tracker(model, first.image, first.points);
  const bool is_deformable = model.segments.front().layout == Layout::kDeformable;
  const TrueParts truth(first, tracker.state(), is_deformable);
  int known = 0;
  int inside = 0;
  for (int i = 1; i <= kFrames; ++i) {
    const SceneFrame frame = scene->render(i);
    const ChainState& state = tracker.update(frame.image);
    for (size_t k = 0; k < state.parts.size(); ++k) {
      const PartState& part = state.parts[k];
      if (!part.visible || !std::isfinite(part.covariance(0, 0))) continue;
      ++known;
      inside += isInside(part, truth.at(frame, k)) ? 1 : 0;
    }
  }
  EXPECT_GT(known, 500);
  return static_cast<double>(inside) / known;
}

TEST(Covariance, ellipsesHoldMostTruePositionsAndNotAll) {
  const std::vector<std::string> scenes = {"bottle", "box",    "robot_arm",     "finger_pair",
                                           "cable",  "suture", "guitar_string", "lips"};
  double mean = 0.0;
  for (const std::string& scene : scenes) {
    const double share = shareInside(scene);
    EXPECT_GE(share, 0.8) << scene;
    RecordProperty("share_inside_" + scene, std::to_string(share));
    mean += share / static_cast<double>(scenes.size());
  }
  EXPECT_LE(mean, 0.99);
}

}  // namespace
}  // namespace chain_tracker
