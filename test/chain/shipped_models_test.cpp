// SPDX-License-Identifier: BSD-3-Clause
/// Every shipped model tracks what it is for, on rendered frames whose truth is exact: its own
/// scene where there is one, else the nearest.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "chain_tracker/chain/chain_model_io.h"
#include "chain_tracker/chain/chain_tracker.h"
#include "chain_tracker/evaluation/metrics.h"
#include "chain_tracker/evaluation/synthetic_scene.h"

namespace chain_tracker {
namespace {

constexpr int kFrames = 120;
const std::string kModels = std::string(CHAIN_TRACKER_SOURCE_DIR) + "/config/models";

double meanDistance(const std::vector<CarriedPoint>& points,
                    const std::vector<cv::Point2d>& truth) {
  double sum = 0.0;
  for (size_t i = 0; i < truth.size(); ++i) sum += cv::norm(points[i].position - truth[i]);
  return sum / static_cast<double>(truth.size());
}

struct Accuracy {
  double point_error = 0.0;  ///< mean over frames and points [px]
  double iou = 0.0;          ///< of the boxes, mean over frames
  double scale_error = 0.0;  ///< of the first segment, largest, log scale
};

Accuracy trackScene(const std::string& model, const std::string& scene_name, unsigned seed) {
  SceneOptions options;
  options.seed = seed;
  const auto scene = makeScene(scene_name, options);
  const SceneFrame first = scene->render(0);
  ChainTracker tracker(loadChainModel(kModels + "/" + model + ".yaml"), first.image, first.points);
  Accuracy accuracy;
  for (int i = 1; i <= kFrames; ++i) {
    const SceneFrame frame = scene->render(i);
    const ChainState& state = tracker.update(frame.image);
    EXPECT_NE(TrackingStatus::kLost, state.status) << "frame " << i;
    accuracy.point_error += meanDistance(state.points, frame.points) / kFrames;
    accuracy.iou += intersectionOverUnion(state.box, frame.box) / kFrames;
    const double scale = state.segments.front().image_from_segment.scale;
    accuracy.scale_error =
        std::max(accuracy.scale_error, std::abs(std::log(scale / frame.image_from_object.scale)));
  }
  return accuracy;
}

/// The seed is the hardest of 1, 2 and 3; the limit is one and a half times its error.
struct Case {
  std::string model;
  std::string scene;
  unsigned seed = 1;
  double most_error = 0.0;  ///< mean point error [px]
};

std::ostream& operator<<(std::ostream& out, const Case& which) { return out << which.model; }

std::vector<Case> cases() {
  return {{"bottle", "bottle", 1, 1.3},
          {"instrument", "bottle", 3, 0.6},
          {"box", "box", 2, 2.5},
          {"person", "box", 3, 3.9},
          {"articulated", "robot_arm", 3, 2.0},
          {"robot_arm", "robot_arm", 3, 2.3},
          {"human_arm", "robot_arm", 3, 1.3},
          {"finger_pair", "finger_pair", 2, 0.9},
          {"pendulum", "finger_pair", 3, 1.5},
          {"cable", "cable", 2, 1.1},
          {"worm", "cable", 1, 3.3},
          {"suture", "suture", 2, 1.7},
          {"guitar_string", "guitar_string", 3, 1.5},
          {"lips", "lips", 2, 2.8}};
}

class ShippedModel : public testing::TestWithParam<Case> {};

TEST_P(ShippedModel, PointsStayNearTheTruth) {
  const Accuracy accuracy = trackScene(GetParam().model, GetParam().scene, GetParam().seed);
  EXPECT_LT(accuracy.point_error, GetParam().most_error);
  RecordProperty("mean_point_error_px", std::to_string(accuracy.point_error));
}

std::string nameOf(const testing::TestParamInfo<Case>& info) { return info.param.model; }

INSTANTIATE_TEST_SUITE_P(Models, ShippedModel, testing::ValuesIn(cases()), nameOf);

/// The bag turns and deforms while its box stays upright: the corners of that box, which are the
/// scene's points, are none of the bag's.
TEST(ShippedPlasticBag, BoxStaysOnTheBag) {
  EXPECT_GT(trackScene("plastic_bag", "plastic_bag", 1).iou, 0.73);
}

/// Points of the box's face, there and back between its corners.
std::vector<cv::Point2d> facePoints(const std::vector<cv::Point2d>& corners) {
  std::vector<cv::Point2d> points;
  for (int row = 0; row < 3; ++row) {
    for (int i = 0; i < 3; ++i) {
      const double x = 0.25 * (1 + (row % 2 == 0 ? i : 2 - i));
      const double y = 0.25 * (1 + row);
      points.push_back((1.0 - y) * ((1.0 - x) * corners[0] + x * corners[1]) +
                       y * ((1.0 - x) * corners[3] + x * corners[2]));
    }
  }
  return points;
}

TEST(ShippedPoints, StayWhereTheyWerePutOnTheFace) {
  SceneOptions options;
  options.seed = 1;
  const auto scene = makeScene("box", options);
  const SceneFrame first = scene->render(0);
  ChainTracker tracker(loadChainModel(kModels + "/points.yaml"), first.image,
                       facePoints(first.points));
  ASSERT_EQ(9U, tracker.state().parts.size());
  double error = 0.0;
  for (int i = 1; i <= kFrames; ++i) {
    const SceneFrame frame = scene->render(i);
    const ChainState& state = tracker.update(frame.image);
    EXPECT_NE(TrackingStatus::kLost, state.status) << "frame " << i;
    error += meanDistance(state.points, facePoints(frame.points)) / kFrames;
  }
  EXPECT_LT(error, 1.4);
  RecordProperty("mean_point_error_px", std::to_string(error));
}

TEST(ShippedModels, AllAreTracked) {
  std::set<std::string> tracked = {"plastic_bag", "points"};
  for (const Case& which : cases()) tracked.insert(which.model);
  std::set<std::string> shipped;
  for (const auto& entry : std::filesystem::directory_iterator(kModels)) {
    shipped.insert(entry.path().stem().string());
  }
  EXPECT_EQ(shipped, tracked);
}

/// This cable coils up, which a similarity would take for a scale of 0.5.
TEST(DeformableSegment, KeepsItsScaleAndItsBoxWhileItCoilsUp) {
  const Accuracy accuracy = trackScene("cable", "cable", 3);
  EXPECT_LT(accuracy.scale_error, 0.08);
  EXPECT_GT(accuracy.iou, 0.8);
}

}  // namespace
}  // namespace chain_tracker
