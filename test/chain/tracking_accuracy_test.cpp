// SPDX-License-Identifier: BSD-3-Clause
/// How near the shipped models stay to the truth, on rendered and on real frames.
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/videoio.hpp>

#include "chain_tracker/chain/auto_model.h"
#include "chain_tracker/chain/chain_model_io.h"
#include "chain_tracker/chain/chain_tracker.h"
#include "chain_tracker/evaluation/synthetic_scene.h"

namespace chain_tracker {
namespace {

using Points = std::vector<cv::Point2d>;

ChainModel shippedModel(const std::string& name) {
  return loadChainModel(std::string(CHAIN_TRACKER_SOURCE_DIR) + "/config/models/" + name + ".yaml");
}

double meanDistance(const std::vector<CarriedPoint>& points, const Points& truth) {
  double sum = 0.0;
  for (size_t i = 0; i < truth.size(); ++i) sum += cv::norm(points[i].position - truth[i]);
  return sum / static_cast<double>(truth.size());
}

/// Annotated points of frames: lines of `frame,part,x,y,visible` below a header.
std::map<int, Points> readAnnotation(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  std::map<int, Points> points;
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    int frame = 0;
    int part = 0;
    cv::Point2d point;
    char comma = 0;
    fields >> frame >> comma >> part >> comma >> point.x >> comma >> point.y;
    EXPECT_TRUE(fields) << path << ": " << line;
    points[frame].push_back(point);
  }
  return points;
}

/// Mean error of the scene's points over its frames [px], with the scene's model.
double meanErrorOn(const std::string& scene_name, unsigned seed, int frames) {
  SceneOptions options;
  options.seed = seed;
  const auto scene = makeScene(scene_name, options);
  const SceneFrame first = scene->render(0);
  const std::string model = scene->model() == "auto" ? autoModelName(first.points) : scene->model();
  ChainTracker tracker(shippedModel(model), first.image, first.points);
  double sum = 0.0;
  for (int i = 1; i <= frames; ++i) {
    const SceneFrame frame = scene->render(i);
    const ChainState& state = tracker.update(frame.image);
    EXPECT_NE(state.status, TrackingStatus::kLost) << "frame " << i;
    sum += meanDistance(state.points, frame.points);
  }
  return sum / frames;
}

class RenderedBottle : public testing::TestWithParam<unsigned> {};

TEST_P(RenderedBottle, EndsStayWithinTwoPixels) {
  EXPECT_LT(meanErrorOn("bottle", GetParam(), 120), 2.0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RenderedBottle, testing::Values(1U, 2U, 3U));

class RenderedObject : public testing::TestWithParam<std::string> {};

TEST_P(RenderedObject, PointsStayWithinTwoPixels) {
  const double error = meanErrorOn(GetParam(), 1, 60);
  EXPECT_LT(error, 2.0);
  RecordProperty("mean_point_error_px", std::to_string(error));
}

INSTANTIATE_TEST_SUITE_P(Scenes, RenderedObject,
                         testing::Values("box", "robot_arm", "finger_pair", "cable", "suture",
                                         "guitar_string", "lips"));

/// The video is not ours to ship: it is tested wherever it has been fetched.
TEST(RealBottle, EndsStayNearTheAnnotation) {
  const std::string path = std::string(CHAIN_TRACKER_CACHE_DIR) + "/cup.mp4";
  cv::VideoCapture video(path);
  if (!video.isOpened()) GTEST_SKIP() << path << " is not there";
  const std::map<int, Points> truth =
      readAnnotation(std::string(CHAIN_TRACKER_SOURCE_DIR) + "/test/data/bottle_ends.csv");
  ASSERT_GE(truth.size(), 12U);
  cv::Mat image;
  ASSERT_TRUE(video.read(image));
  ChainTracker tracker(shippedModel("bottle"), image, truth.at(0));
  double sum = 0.0;
  int compared = 0;
  for (int frame = 1; video.read(image); ++frame) {
    const ChainState& state = tracker.update(image);
    ASSERT_NE(state.status, TrackingStatus::kLost) << "frame " << frame;
    const auto annotated = truth.find(frame);
    if (annotated == truth.end()) continue;
    sum += meanDistance(state.points, annotated->second);
    ++compared;
  }
  ASSERT_EQ(compared, static_cast<int>(truth.size()) - 1);
  EXPECT_LT(sum / compared, 6.5);
  RecordProperty("mean_end_error_px", std::to_string(sum / compared));
}

}  // namespace
}  // namespace chain_tracker
