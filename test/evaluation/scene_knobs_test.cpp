// SPDX-License-Identifier: BSD-3-Clause
/// Scene options do what they say, as measured in the pictures.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "../support/scene_probes.h"

namespace chain_tracker {
namespace {

TEST(SceneKnobs, NoiseHasItsStandardDeviation) {
  SceneOptions noisy = cleanSceneOptions();
  noisy.noise = 6.0;
  const cv::Mat3b clean = makeScene("bottle", cleanSceneOptions())->render(0).image;
  const cv::Mat3b image = makeScene("bottle", noisy)->render(0).image;
  cv::Mat difference;
  cv::subtract(image, clean, difference, cv::noArray(), CV_32FC3);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(difference, mean, deviation);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(deviation[c], 6.0, 0.2);
}

TEST(SceneKnobs, GreyHasEqualChannelsAndItsNoise) {
  SceneOptions grey = cleanSceneOptions();
  grey.grey = true;
  const cv::Mat3b clean = makeScene("cable", grey)->render(5).image;
  grey.noise = 5.0;
  const cv::Mat3b image = makeScene("cable", grey)->render(5).image;
  cv::Mat channels[3];
  cv::split(image, channels);
  EXPECT_EQ(cv::norm(channels[0], channels[1], cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(channels[0], channels[2], cv::NORM_INF), 0.0);
  cv::Mat difference;
  cv::subtract(image, clean, difference, cv::noArray(), CV_32FC3);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(difference, mean, deviation);
  EXPECT_NEAR(deviation[0], 5.0, 0.2);
}

TEST(SceneKnobs, ShiftBurstMovesByItsRateAndDoesNothingElse) {
  SceneOptions options = cleanSceneOptions();
  options.shift_bursts = {{20, 4, 15.0}};
  for (const std::string name : {"bottle", "cable", "lips"}) {
    const auto scene = makeScene(name, options);
    for (int index = 20; index < 24; ++index) {
      const SceneFrame before = scene->render(index);
      const SceneFrame after = scene->render(index + 1);
      const cv::Point2d shift = after.points[0] - before.points[0];
      EXPECT_NEAR(cv::norm(shift), 15.0, 1e-6) << name;
      for (size_t i = 0; i < before.points.size(); ++i) {
        EXPECT_NEAR(cv::norm(after.points[i] - before.points[i] - shift), 0.0, 1e-6) << name;
      }
    }
  }
}

TEST(SceneKnobs, ShiftBurstIsSeen) {
  SceneOptions options = cleanSceneOptions();
  options.shift_bursts = {{20, 4, 15.0}};
  const auto scene = makeScene("bottle", options);
  for (int index = 20; index < 24; ++index) {
    const cv::Point2d seen =
        poseOf(objectMask(*scene, index + 1)).center - poseOf(objectMask(*scene, index)).center;
    EXPECT_NEAR(cv::norm(seen), 15.0, 1.5) << index;
  }
}

TEST(SceneKnobs, ShiftBurstsKeepTheObjectInView) {
  SceneOptions options = cleanSceneOptions();
  options.shift_bursts = {{10, 60, 30.0}};
  const auto scene = makeScene("bottle", options);
  for (int index = 10; index <= 70; ++index) {
    const cv::Point2d middle = scene->render(index).image_from_object.translation;
    EXPECT_TRUE(cv::Rect2d(0.0, 0.0, 320.0, 240.0).contains(middle)) << index;
  }
}

TEST(SceneKnobs, RotationBurstTurnsByItsRate) {
  SceneOptions options = cleanSceneOptions();
  options.rotation_bursts = {{20, 5, -0.4}};
  for (const std::string name : {"bottle", "robot_arm", "suture"}) {
    const auto scene = makeScene(name, options);
    for (int index = 20; index < 25; ++index) {
      const double before = scene->render(index).segments[0].angle;
      const double after = scene->render(index + 1).segments[0].angle;
      EXPECT_NEAR(wrapAngle(after - before), -0.4, 1e-3) << name;
    }
  }
}

TEST(SceneKnobs, RotationBurstIsSeen) {
  SceneOptions options = cleanSceneOptions();
  options.rotation_bursts = {{20, 3, 0.3}};
  const auto scene = makeScene("bottle", options);
  for (int index = 20; index < 23; ++index) {
    const double turn = poseOf(objectMask(*scene, index + 1)).direction -
                        poseOf(objectMask(*scene, index)).direction;
    EXPECT_NEAR(std::remainder(turn, CV_PI), 0.3, 0.04) << index;
  }
}

TEST(SceneKnobs, RotationIsTheFastestTurn) {
  SceneOptions options = cleanSceneOptions();
  options.rotation = 0.12;
  for (const std::string name : {"bottle", "robot_arm"}) {
    const auto scene = makeScene(name, options);
    double fastest = 0.0;
    for (int index = 0; index < 300; ++index) {
      const double before = scene->render(index).segments[0].angle;
      const double after = scene->render(index + 1).segments[0].angle;
      fastest = std::max(fastest, std::abs(wrapAngle(after - before)));
    }
    EXPECT_LE(fastest, 0.12) << name;
    EXPECT_GE(fastest, 0.03) << name;
  }
}

double travel(const SyntheticScene& scene, int frames) {
  double sum = 0.0;
  cv::Point2d last = scene.render(0).image_from_object.translation;
  for (int index = 1; index < frames; ++index) {
    const cv::Point2d next = scene.render(index).image_from_object.translation;
    sum += cv::norm(next - last);
    last = next;
  }
  return sum;
}

TEST(SceneKnobs, SpeedMultipliesTheShift) {
  SceneOptions fast = cleanSceneOptions();
  fast.speed = 2.0;
  // Twice as fast over half the time is the same way.
  const double usual = travel(*makeScene("box", cleanSceneOptions()), 200);
  EXPECT_NEAR(travel(*makeScene("box", fast), 100) / usual, 1.0, 0.03);
}

TEST(SceneKnobs, ScaleStaysWithinItsRange) {
  for (double range : {1.0, 1.8}) {
    SceneOptions options = cleanSceneOptions();
    options.scale_range = range;
    const auto scene = makeScene("bottle", options);
    double low = 1e9;
    double high = 0.0;
    for (int index = 0; index < 300; index += 3) {
      const double scale = scene->render(index).segments[0].scale;
      low = std::min(low, scale);
      high = std::max(high, scale);
    }
    EXPECT_LE(high / low, range * range + 1e-9);
    EXPECT_GE(high / low, std::pow(range, 1.2) - 1e-9);
  }
}

/// While the shutter is open the object moves on: its picture grows by that way.
TEST(SceneKnobs, BlurSmearsAlongTheMotion) {
  SceneOptions options = cleanSceneOptions();
  options.shift_bursts = {{20, 4, 20.0}};
  const auto sharp = makeScene("bottle", options);
  options.blur = 0.8;
  const auto blurred = makeScene("bottle", options);
  // Frame 22 is in the middle of a straight stretch if both steps around it are equal.
  const cv::Point2d before = sharp->render(22).points[0] - sharp->render(21).points[0];
  const cv::Point2d after = sharp->render(23).points[0] - sharp->render(22).points[0];
  ASSERT_NEAR(cv::norm(after - before), 0.0, 1e-6);
  const cv::Point2d direction = before / cv::norm(before);
  const double smear = extentAlong(objectMask(*blurred, 22), direction) -
                       extentAlong(objectMask(*sharp, 22), direction);
  EXPECT_NEAR(smear, 0.8 * 20.0, 4.0);
  // The truth is that of the middle of the exposure.
  EXPECT_EQ(sharp->render(22).points, blurred->render(22).points);
}

TEST(SceneKnobs, GuitarStringIsBlurredByItself) {
  SceneOptions options = cleanSceneOptions();
  const cv::Mat3b sharp = makeScene("guitar_string", options)->render(8).image;
  options.blur.reset();
  EXPECT_FALSE(samePicture(sharp, makeScene("guitar_string", options)->render(8).image));
}

TEST(SceneKnobs, IlluminationDriftsWithinItsRange) {
  const auto steady = makeScene("box", cleanSceneOptions());
  SceneOptions options = cleanSceneOptions();
  options.illumination = 0.3;
  const auto drifting = makeScene("box", options);
  double low = 1e9;
  double high = 0.0;
  for (int index = 0; index < 300; index += 10) {
    const double light = cv::mean(drifting->renderWithoutObject(index))[1] /
                         cv::mean(steady->renderWithoutObject(index))[1];
    low = std::min(low, light);
    high = std::max(high, light);
  }
  EXPECT_GE(low, 0.69);
  EXPECT_LE(high, 1.31);
  EXPECT_GE(high - low, 0.2);
}

TEST(SceneKnobs, BackgroundMovesNoFasterThanAsked) {
  SceneOptions options = cleanSceneOptions();
  const auto still = makeScene("cable", options);
  EXPECT_TRUE(samePicture(still->renderWithoutObject(3), still->renderWithoutObject(50)));
  options.background_speed = 6.0;
  const auto moving = makeScene("cable", options);
  double fastest = 0.0;
  cv::Mat1f last;
  for (int index = 0; index < 60; ++index) {
    cv::Mat grey;
    cv::cvtColor(moving->renderWithoutObject(index), grey, cv::COLOR_BGR2GRAY);
    cv::Mat1f next;
    grey.convertTo(next, CV_32F);
    if (!last.empty()) fastest = std::max(fastest, cv::norm(cv::phaseCorrelate(last, next)));
    last = next;
  }
  EXPECT_LE(fastest, 6.3);
  EXPECT_GE(fastest, 2.0);
}

TEST(SceneKnobs, ClutterAddsToTheBackground) {
  for (const std::string name : {"bottle", "robot_arm", "suture", "plastic_bag"}) {
    SceneOptions options = cleanSceneOptions();
    options.clutter = 0;
    const cv::Mat3b empty = makeScene(name, options)->renderWithoutObject(0);
    options.clutter = 2;
    const int few =
        cv::countNonZero(changedPixels(empty, makeScene(name, options)->renderWithoutObject(0)));
    options.clutter = 12;
    const int many =
        cv::countNonZero(changedPixels(empty, makeScene(name, options)->renderWithoutObject(0)));
    EXPECT_GT(few, 30) << name;
    EXPECT_GT(many, 2 * few) << name;
  }
}

double variationAlong(const SceneFrame& frame) {
  cv::Mat3f colors(1, static_cast<int>(frame.points.size()) - 2);
  for (int i = 0; i < colors.cols; ++i) {
    const cv::Point2d& point = frame.points[static_cast<size_t>(i) + 1];
    colors(0, i) = frame.image(cv::Point(cvRound(point.x), cvRound(point.y)));
  }
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(colors, mean, deviation);
  return deviation[0] + deviation[1] + deviation[2];
}

TEST(SceneKnobs, PlainStrandsHaveOneColour) {
  SceneOptions options = cleanSceneOptions();
  options.size = {640, 480};
  for (const std::string name : {"cable", "suture"}) {
    options.plain = false;
    const double banded = variationAlong(makeScene(name, options)->render(0));
    options.plain = true;
    EXPECT_LT(variationAlong(makeScene(name, options)->render(0)), 0.6 * banded) << name;
  }
}

TEST(SceneKnobs, ShadowDarkensTheBackground) {
  SceneOptions options = cleanSceneOptions();
  const auto without = makeScene("box", options);
  options.shadow = 0.5;
  options.clutter = 0;  // clutter casts shadows too
  const auto with = makeScene("box", options);
  const cv::Rect2d box = with->render(0).box;
  const cv::Mat3b lit = with->renderWithoutObject(0);
  const cv::Mat3b shaded = with->render(0).image;
  const cv::Rect below = cv::Rect(cvRound(box.x + 0.4 * box.width), cvRound(box.br().y) - 2,
                                  cvRound(0.3 * box.width), 8) &
                         cv::Rect(0, 0, 320, 240);
  cv::Mat1b outside;
  cv::bitwise_not(objectMask(*without, 0), outside);
  EXPECT_LT(cv::mean(shaded(below), outside(below))[1],
            0.95 * cv::mean(lit(below), outside(below))[1]);
}

SceneOptions occlusionOptions() {
  SceneOptions options = cleanSceneOptions();
  options.frames = 100;
  options.occlusions = 1;
  options.occlusion_frames = 12;
  options.occluder_size = 0.8;
  return options;
}

/// At hidden points the picture is not the one without occluders, at visible points it is.
TEST(SceneKnobs, OccludedPointsAreHidden) {
  SceneOptions open = occlusionOptions();
  open.occlusions = 0;
  for (const std::string name : {"cable", "box", "robot_arm", "lips"}) {
    const auto covered_scene = makeScene(name, occlusionOptions());
    const auto open_scene = makeScene(name, open);
    int hidden = 0;
    int hidden_unchanged = 0;
    int visible = 0;
    int visible_changed = 0;
    for (int index = 30; index < 70; index += 2) {
      const SceneFrame frame = covered_scene->render(index);
      const cv::Mat1b changed = changedPixels(frame.image, open_scene->render(index).image, 0.0);
      for (size_t i = 0; i < frame.points.size(); ++i) {
        const cv::Point pixel(cvRound(frame.points[i].x), cvRound(frame.points[i].y));
        if (!cv::Rect(0, 0, 320, 240).contains(pixel)) continue;
        (frame.visible[i] ? visible : hidden) += 1;
        if (frame.visible[i] && changed(pixel) > 0) ++visible_changed;
        if (!frame.visible[i] && changed(pixel) == 0) ++hidden_unchanged;
      }
    }
    EXPECT_GT(hidden, 5) << name;
    EXPECT_GT(visible, 5) << name;
    EXPECT_LE(hidden_unchanged, hidden / 20) << name;
    EXPECT_LE(visible_changed, visible / 20) << name;  // at the occluder's rim
  }
}

TEST(SceneKnobs, OcclusionLastsAsLongAsAsked) {
  SceneOptions open = occlusionOptions();
  open.occlusions = 0;
  const auto open_scene = makeScene("bottle", open);
  for (int frames : {6, 14}) {
    SceneOptions options = occlusionOptions();
    options.occlusion_frames = frames;
    const auto scene = makeScene("bottle", options);
    int covered = 0;
    for (int index = 0; index < options.frames; ++index) {
      const SceneFrame frame = scene->render(index);
      const cv::Point2d middle = 0.5 * (frame.points[0] + frame.points[1]);
      const cv::Mat1b changed = changedPixels(frame.image, open_scene->render(index).image, 0.0);
      if (changed(cv::Point(cvRound(middle.x), cvRound(middle.y))) > 0) ++covered;
      if (index == 0) {
        EXPECT_EQ(frame.visible, std::vector<bool>({true, true}));
      }
    }
    EXPECT_NEAR(covered, frames, 1);
  }
}

}  // namespace
}  // namespace chain_tracker
