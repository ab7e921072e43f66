// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/evaluation/synthetic_scene.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

SceneOptions noiseless() {
  SceneOptions options;
  options.noise = 0.0;
  return options;
}

bool equal(const cv::Mat3b& a, const cv::Mat3b& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

TEST(SyntheticScene, SameSeedSamePictures) {
  const auto scene = makeScene("bottle", SceneOptions());
  const auto again = makeScene("bottle", SceneOptions());
  again->render(3);  // what was rendered before does not matter
  EXPECT_TRUE(equal(scene->render(7).image, again->render(7).image));
  EXPECT_EQ(scene->render(7).points, again->render(7).points);
}

TEST(SyntheticScene, AnotherSeedGivesAnotherPicture) {
  SceneOptions other;
  other.seed = 2;
  EXPECT_FALSE(equal(makeScene("bottle", SceneOptions())->render(0).image,
                     makeScene("bottle", other)->render(0).image));
}

TEST(SyntheticScene, PointsFollowThePose) {
  const auto scene = makeScene("bottle", SceneOptions());
  for (int index : {0, 40, 123}) {
    const SceneFrame frame = scene->render(index);
    ASSERT_EQ(frame.points.size(), 2U);
    const cv::Point2d axis = frame.points[1] - frame.points[0];
    EXPECT_NEAR(wrapAngle(directionOf(axis) - frame.image_from_object.angle), 0.0, 1e-9);
    const cv::Point2d middle = (frame.points[0] + frame.points[1]) / 2.0;
    EXPECT_NEAR(cv::norm(middle - frame.image_from_object.translation), 0.0, 1e-9);
  }
}

/// A frame in which the object is nowhere near `point`.
SceneFrame frameAwayFrom(const SyntheticScene& scene, const cv::Point2d& point) {
  for (int index = 20; index < 2000; index += 20) {
    const SceneFrame frame = scene.render(index);
    cv::Rect2d box = uprightBounds(frame.points);
    box = cv::Rect2d(box.x - 60.0, box.y - 60.0, box.width + 120.0, box.height + 120.0);
    if (!box.contains(point)) return frame;
  }
  throw std::logic_error("the object never leaves the place");
}

/// Two frames without noise differ where the bottle was or is, and nowhere else: the change begins
/// at the ends that the truth names.
TEST(SyntheticScene, TruthIsWhereThePictureChanges) {
  const auto scene = makeScene("bottle", noiseless());
  const SceneFrame first = scene->render(0);
  const cv::Point2d axis = first.points[1] - first.points[0];
  for (int end : {0, 1}) {
    const cv::Point2d point = first.points[static_cast<size_t>(end)];
    const cv::Point2d outwards = axis * ((end == 0 ? -1.0 : 1.0) / cv::norm(axis));
    const SceneFrame away = frameAwayFrom(*scene, point);
    const auto changed = [&](const cv::Point2d& at) {
      const cv::Point pixel(cvRound(at.x), cvRound(at.y));
      return cv::norm(first.image(pixel), away.image(pixel)) > 0.0;
    };
    EXPECT_TRUE(changed(point - 3.0 * outwards)) << "inside end " << end;
    EXPECT_FALSE(changed(point + 3.0 * outwards)) << "outside end " << end;
  }
}

TEST(SyntheticScene, NoiseHasTheStandardDeviationAskedFor) {
  SceneOptions noisy;
  noisy.noise = 6.0;
  const cv::Mat3b clean = makeScene("bottle", noiseless())->render(0).image;
  const cv::Mat3b image = makeScene("bottle", noisy)->render(0).image;
  cv::Mat difference;
  cv::subtract(image, clean, difference, cv::noArray(), CV_32FC3);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(difference, mean, deviation);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(deviation[c], 6.0, 0.2);
}

TEST(SyntheticScene, RefusesWhatItCannotRender) {
  EXPECT_THROW(makeScene("teapot", SceneOptions()), std::invalid_argument);
  SceneOptions tiny;
  tiny.size = {10, 10};
  EXPECT_THROW(makeScene("bottle", tiny), std::invalid_argument);
  SceneOptions negative;
  negative.noise = -1.0;
  EXPECT_THROW(makeScene("bottle", negative), std::invalid_argument);
  SceneOptions empty;
  empty.frames = 0;
  EXPECT_THROW(makeScene("bottle", empty), std::invalid_argument);
}

}  // namespace
}  // namespace chain_tracker
