// SPDX-License-Identifier: BSD-3-Clause
/// Every scene: the same picture for the same question, and a truth that agrees with the picture.
#include "chain_tracker/evaluation/synthetic_scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <stdexcept>

#include <gtest/gtest.h>

#include "../support/scene_probes.h"

namespace chain_tracker {
namespace {

class EveryScene : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<SyntheticScene> clean() const {
    return makeScene(GetParam(), cleanSceneOptions());
  }
};

/// Everything that can be random at once.
SceneOptions busyOptions() {
  SceneOptions options;
  options.size = {320, 240};
  options.blur = 0.6;
  options.illumination = 0.3;
  options.clutter = 3;
  options.background_speed = 2.0;
  options.occlusions = 1;
  options.frames = 60;
  options.shift_bursts = {{10, 3, 12.0}};
  options.rotation_bursts = {{20, 3, 0.3}};
  return options;
}

TEST_P(EveryScene, SameQuestionSamePicture) {
  for (const SceneOptions& options : {SceneOptions(), busyOptions()}) {
    const auto scene = makeScene(GetParam(), options);
    const auto again = makeScene(GetParam(), options);
    again->render(30);  // what was rendered before does not matter
    const SceneFrame frame = scene->render(12);
    const SceneFrame same = again->render(12);
    EXPECT_TRUE(samePicture(frame.image, same.image));
    EXPECT_EQ(frame.points, same.points);
    EXPECT_EQ(frame.visible, same.visible);
    EXPECT_TRUE(samePicture(frame.image, scene->render(12).image));
  }
}

TEST_P(EveryScene, IsRenderedInSmallImagesToo) {
  for (const cv::Size size : {cv::Size(64, 64), cv::Size(160, 120), cv::Size(64, 480)}) {
    for (SceneOptions options : {SceneOptions(), busyOptions()}) {
      options.size = size;
      const auto scene = makeScene(GetParam(), options);
      for (const int index : {0, 1, 30}) {
        const SceneFrame frame = scene->render(index);
        EXPECT_EQ(frame.image.size(), size);
        cv::Scalar mean;
        cv::Scalar deviation;
        cv::meanStdDev(frame.image, mean, deviation);
        EXPECT_GT(deviation[0], 3.0) << size << " shows nothing but noise";
      }
    }
  }
}

TEST_P(EveryScene, AnotherSeedGivesAnotherPicture) {
  SceneOptions other = cleanSceneOptions();
  other.seed = 2;
  EXPECT_FALSE(
      samePicture(clean()->render(0).image, makeScene(GetParam(), other)->render(0).image));
}

TEST_P(EveryScene, HasItsModelAndItsPoints) {
  const std::map<std::string, size_t> points{
      {"bottle", 2},  {"box", 4},   {"robot_arm", 4},      {"finger_pair", 5}, {"cable", 30},
      {"suture", 40}, {"lips", 12}, {"guitar_string", 30}, {"plastic_bag", 4}};
  const std::map<std::string, size_t> segments{{"robot_arm", 3}, {"finger_pair", 4}};
  const auto scene = clean();
  const std::filesystem::path models = CHAIN_TRACKER_SOURCE_DIR "/config/models";
  EXPECT_TRUE(scene->model() == "auto" ||
              std::filesystem::exists(models / (scene->model() + ".yaml")))
      << scene->model();
  const SceneFrame frame = scene->render(40);
  EXPECT_EQ(frame.points.size(), points.at(GetParam()));
  EXPECT_EQ(frame.visible.size(), frame.points.size());
  const auto several = segments.find(GetParam());
  EXPECT_EQ(frame.segments.size(), several == segments.end() ? 1U : several->second);
}

TEST_P(EveryScene, BeginsInViewAtScaleOne) {
  for (unsigned seed : {1U, 2U, 3U, 4U}) {
    SceneOptions options = cleanSceneOptions();
    options.seed = seed;
    const SceneFrame frame = makeScene(GetParam(), options)->render(0);
    EXPECT_TRUE(frame.in_view);
    EXPECT_EQ(std::count(frame.visible.begin(), frame.visible.end(), false), 0) << "seed " << seed;
    for (const Similarity& segment : frame.segments) EXPECT_NEAR(segment.scale, 1.0, 1e-9);
    EXPECT_NEAR(frame.image_from_object.scale, 1.0, 1e-9);
  }
}

/// The pixels that the object changes are those in its box, and reach each of its sides.
TEST_P(EveryScene, BoxIsWhereThePictureChanges) {
  const auto scene = clean();
  for (int index : {0, 70, 150}) {
    SCOPED_TRACE(index);
    const cv::Rect2d box = scene->render(index).box;
    const cv::Rect changed = cv::boundingRect(objectMask(*scene, index));
    const double tolerance = 2.0;
    // Pixels reach half a pixel beyond their centres; the image cuts what sticks out of it.
    EXPECT_NEAR(changed.x - 0.5, std::max(box.x, -0.5), tolerance);
    EXPECT_NEAR(changed.y - 0.5, std::max(box.y, -0.5), tolerance);
    EXPECT_NEAR(changed.br().x - 0.5, std::min(box.br().x, 319.5), tolerance);
    EXPECT_NEAR(changed.br().y - 0.5, std::min(box.br().y, 239.5), tolerance);
  }
}

TEST_P(EveryScene, PointsAreOnTheObject) {
  if (GetParam() == "plastic_bag") GTEST_SKIP() << "its points are the corners of its box";
  const auto scene = clean();
  for (int index : {0, 70, 150}) {
    const SceneFrame frame = scene->render(index);
    const cv::Mat1b mask = objectMask(*scene, index);
    for (size_t i = 0; i < frame.points.size(); ++i) {
      if (!frame.visible[i]) continue;
      EXPECT_TRUE(isSetNear(mask, frame.points[i], 2)) << "frame " << index << " point " << i;
    }
  }
}

TEST_P(EveryScene, PointsOutsideTheImageAreNotVisible) {
  SceneOptions options = cleanSceneOptions();
  options.leave_at = 60;
  options.leave_for = 10;
  const auto scene = makeScene(GetParam(), options);
  for (int index : {60, 69}) {
    const SceneFrame away = scene->render(index);
    EXPECT_FALSE(away.in_view);
    EXPECT_EQ(std::count(away.visible.begin(), away.visible.end(), true), 0);
    EXPECT_TRUE(samePicture(away.image, scene->renderWithoutObject(index)));
  }
  for (int index = 40; index < 60; ++index) {
    const SceneFrame leaving = scene->render(index);
    for (size_t i = 0; i < leaving.points.size(); ++i) {
      const bool inside = leaving.points[i].x > -0.5 && leaving.points[i].x < 319.5 &&
                          leaving.points[i].y > -0.5 && leaving.points[i].y < 239.5;
      EXPECT_EQ(leaving.visible[i], inside) << "frame " << index << " point " << i;
    }
  }
  EXPECT_TRUE(scene->render(110).in_view);
}

std::string nameOf(const testing::TestParamInfo<std::string>& info) { return info.param; }

INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene, testing::ValuesIn(sceneNames()), nameOf);

/// Chains whose first and last points are tips: a little further out there is nothing.
class SceneWithTips : public EveryScene {};

TEST_P(SceneWithTips, NothingBeyondTheTips) {
  const auto scene = clean();
  for (int index : {0, 70, 150}) {
    const SceneFrame frame = scene->render(index);
    const cv::Mat1b mask = objectMask(*scene, index);
    const size_t last = frame.points.size() - 1;
    for (const size_t tip : {size_t{0}, last}) {
      if (GetParam() == "robot_arm" && tip == 0) continue;  // its base
      if (!frame.visible[tip]) continue;
      const cv::Point2d inwards = frame.points[tip == 0 ? 1 : last - 1] - frame.points[tip];
      const cv::Point2d outwards = inwards * (-1.0 / cv::norm(inwards));
      EXPECT_TRUE(isSetNear(mask, frame.points[tip] - 2.0 * outwards, 1)) << index << " " << tip;
      EXPECT_FALSE(isSetNear(mask, frame.points[tip] + 4.0 * outwards, 1)) << index << " " << tip;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, SceneWithTips,
                         testing::Values("bottle", "robot_arm", "finger_pair", "cable", "suture",
                                         "guitar_string"),
                         nameOf);

cv::Vec3d colorAt(const cv::Mat3b& image, const cv::Point2d& point) {
  return image(cv::Point(cvRound(point.x), cvRound(point.y)));
}

/// The bands stay where they are on the cable while it bends and shifts.
TEST(Cable, PointsAreMaterial) {
  SceneOptions options = cleanSceneOptions();
  options.size = {640, 480};
  const auto scene = makeScene("cable", options);
  const SceneFrame first = scene->render(0);
  const SceneFrame later = scene->render(90);
  double own = 0.0;
  double shifted = 0.0;
  for (size_t i = 1; i + 2 < first.points.size(); ++i) {
    const cv::Vec3d color = colorAt(first.image, first.points[i]);
    own += cv::norm(color - colorAt(later.image, later.points[i]));
    shifted += cv::norm(color - colorAt(later.image, later.points[i + 1]));
  }
  EXPECT_LT(own, 0.4 * shifted);
}

TEST(Cable, NeitherStretchesNorTears) {
  const auto scene = makeScene("cable", cleanSceneOptions());
  const auto lengthIn = [&](int index) {
    const SceneFrame frame = scene->render(index);
    double length = 0.0;
    for (size_t i = 1; i < frame.points.size(); ++i) {
      length += cv::norm(frame.points[i] - frame.points[i - 1]);
    }
    return length / frame.image_from_object.scale;
  };
  for (int index : {30, 150, 299}) EXPECT_NEAR(lengthIn(index), lengthIn(0), 0.02 * lengthIn(0));
}

TEST(RobotArm, SegmentsLeadFromJointToJoint) {
  const SceneFrame frame = makeScene("robot_arm", cleanSceneOptions())->render(77);
  for (size_t i = 0; i < frame.segments.size(); ++i) {
    const cv::Point2d along = frame.points[i + 1] - frame.points[i];
    EXPECT_NEAR(cv::norm(frame.segments[i].translation - frame.points[i]), 0.0, 1e-9);
    EXPECT_NEAR(wrapAngle(directionOf(along) - frame.segments[i].angle), 0.0, 1e-9);
  }
}

TEST(Bottle, PointsFollowThePose) {
  const auto scene = makeScene("bottle", SceneOptions());
  for (int index : {0, 40, 123}) {
    const SceneFrame frame = scene->render(index);
    const cv::Point2d axis = frame.points[1] - frame.points[0];
    EXPECT_NEAR(wrapAngle(directionOf(axis) - frame.image_from_object.angle), 0.0, 1e-9);
    const cv::Point2d middle = (frame.points[0] + frame.points[1]) / 2.0;
    EXPECT_NEAR(cv::norm(middle - frame.image_from_object.translation), 0.0, 1e-9);
  }
}

TEST(SyntheticScene, RefusesUnknownNames) {
  try {
    makeScene("teapot", SceneOptions());
    FAIL() << "a teapot was made";
  } catch (const std::invalid_argument& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("teapot"), std::string::npos) << text;
    for (const std::string& name : sceneNames()) EXPECT_NE(text.find(name), std::string::npos);
  }
}

}  // namespace
}  // namespace chain_tracker
