// SPDX-License-Identifier: BSD-3-Clause
/// How objects are given to the running tracker: the service, the topic, the past.
#include <limits>
#include <string>
#include <vector>

#include <geometry_msgs/PolygonStamped.h>
#include <gtest/gtest.h>
#include <ros/ros.h>

#include "ros/tracker_client.h"

namespace chain_tracker {
namespace {

BottlePose leftBottle() {
  BottlePose pose;
  pose.centre = {80.0, 120.0};
  return pose;
}

BottlePose rightBottle() {
  BottlePose pose;
  pose.centre = {230.0, 120.0};
  return pose;
}

class SetTargetTest : public testing::Test {
 protected:
  explicit SetTargetTest(const std::string& tracker = "tracker",
                         const std::string& image_topic = "image")
      : client_(tracker, image_topic), image_(scene_.with({leftBottle(), rightBottle()})) {}
  void SetUp() override { ASSERT_TRUE(client_.ready()); }
  void TearDown() override {
    for (const std::string id : {"left", "right", "hand"}) client_.remove(id);
  }

  RenderedScene scene_;
  TrackerClient client_;
  cv::Mat image_;
};

TEST_F(SetTargetTest, TracksSeveralObjects) {
  EXPECT_TRUE(client_.setTarget(bottleRequest("right", rightBottle()), image_).success);
  EXPECT_TRUE(client_.setTarget(bottleRequest("left", leftBottle()), image_).success);
  const auto objects = client_.show(image_);
  ASSERT_TRUE(objects);
  ASSERT_EQ(objects->objects.size(), 2u);
  EXPECT_EQ(objects->objects[0].id, "left");
  EXPECT_TRUE(isAt(objectOf(objects, "left"), leftBottle()));
  EXPECT_TRUE(isAt(objectOf(objects, "right"), rightBottle()));
}

TEST_F(SetTargetTest, NoIdAndNoModelMeanTheDefaults) {
  const auto answer = client_.setTarget(bottleRequest("", leftBottle()), image_);
  EXPECT_TRUE(answer.success) << answer.message;
  const auto object = objectOf(client_.show(image_), "hand");
  ASSERT_TRUE(object);
  EXPECT_EQ(object->model, "bottle");
  EXPECT_TRUE(client_.call<RemoveTarget>("remove_target").response.success);
  EXPECT_FALSE(objectOf(client_.show(image_), "hand"));
}

TEST_F(SetTargetTest, TakesAModelFile) {
  SetTarget::Request request = bottleRequest("left", leftBottle());
  request.model = std::string(CHAIN_TRACKER_SOURCE_DIR) + "/config/models/worm.yaml";
  const auto answer = client_.setTarget(request, image_);
  EXPECT_TRUE(answer.success) << answer.message;
  const auto object = objectOf(client_.show(image_), "left");
  ASSERT_TRUE(object);
  EXPECT_EQ(object->model, "worm");
}

struct Nonsense {
  std::string name;
  std::string model;
  std::vector<cv::Point2d> points;
  std::string reason;  ///< must be part of the answer
};

class NonsenseTest : public SetTargetTest, public testing::WithParamInterface<Nonsense> {};

TEST_P(NonsenseTest, IsRefusedWithTheReasonAndTheOthersAreTracked) {
  ASSERT_TRUE(client_.setTarget(bottleRequest("left", leftBottle()), image_).success);
  SetTarget::Request request = targetRequest("right", GetParam().points);
  request.model = GetParam().model;
  const auto answer = client_.setTarget(request, image_);
  EXPECT_FALSE(answer.success);
  EXPECT_NE(answer.message.find(GetParam().reason), std::string::npos) << answer.message;
  const auto objects = client_.show(image_);
  EXPECT_FALSE(objectOf(objects, "right"));
  EXPECT_TRUE(isAt(objectOf(objects, "left"), leftBottle()));
}

const double kNaN = std::numeric_limits<double>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    All, NonsenseTest,
    testing::Values(Nonsense{"UnknownModel", "teapot", {{80, 70}, {80, 170}}, "'teapot'"},
                    Nonsense{"MissingFile", "/nowhere/x.yaml", {{80, 70}, {80, 170}}, "/nowhere"},
                    Nonsense{"NoPoints", "", {}, "0"}, Nonsense{"OnePoint", "", {{80, 70}}, "1"},
                    Nonsense{"ThreePoints", "bottle", {{80, 70}, {90, 80}, {100, 70}}, "3"},
                    Nonsense{"Coincident", "", {{80, 70}, {80, 70}}, "80"},
                    Nonsense{"Outside", "", {{80, 70}, {80, 1170}}, "1170"},
                    Nonsense{"Negative", "", {{-800, 70}, {-800, 170}}, "-8"},
                    Nonsense{"NaN", "", {{kNaN, 70}, {80, 170}}, "nan"}),
    [](const auto& instance) { return instance.param.name; });

TEST_F(SetTargetTest, AReplacementThatIsRefusedLeavesTheOldObject) {
  ASSERT_TRUE(client_.setTarget(bottleRequest("left", leftBottle()), image_).success);
  EXPECT_FALSE(client_.setTarget(targetRequest("left", {{5000, 0}, {5000, 10}}), image_).success);
  EXPECT_TRUE(isAt(objectOf(client_.show(image_), "left"), leftBottle()));
}

TEST_F(SetTargetTest, WithoutImagesItAnswersAfterTheTimeout) {
  const ros::WallTime start = ros::WallTime::now();
  const auto answer = client_.setTarget(bottleRequest("left", leftBottle()), cv::Mat());
  const double seconds = (ros::WallTime::now() - start).toSec();
  EXPECT_FALSE(answer.success);
  EXPECT_NE(answer.message.find("no image on topic /image within 1 s"), std::string::npos)
      << answer.message;
  EXPECT_GT(seconds, 0.9);
  EXPECT_LT(seconds, kDeadline / 2);
  const auto objects = client_.show(image_);
  ASSERT_TRUE(objects);
  EXPECT_TRUE(objects->objects.empty()) << "refused, yet tracked";
}

TEST_F(SetTargetTest, TakesAnImageOfThePast) {
  BottlePose pose = leftBottle();
  ros::Time past;
  for (int k = 0; k < 6; ++k) {
    pose.centre.x += 6.0;
    const auto image = imageMsg(scene_.with({pose}), nextStamp());
    if (k == 1) past = image->header.stamp;
    ASSERT_TRUE(client_.show(*image));
  }
  BottlePose then = leftBottle();
  then.centre.x += 12.0;
  SetTarget::Request request = bottleRequest("left", then);
  request.stamp = past;
  const auto answer = client_.setTarget(request, cv::Mat());
  ASSERT_TRUE(answer.success) << answer.message;
  pose.centre.x += 6.0;
  const auto object = objectOf(client_.show(scene_.with({pose})), "left");
  EXPECT_TRUE(isAt(object, pose));
  EXPECT_EQ(object->state, TrackedObject::TRACKING);
}

TEST_F(SetTargetTest, RefusesStampsItDoesNotHold) {
  std::vector<ros::Time> stamps;
  for (int k = 0; k < 12; ++k) {
    stamps.push_back(nextStamp());
    ASSERT_TRUE(client_.show(*imageMsg(image_, stamps.back())));
  }
  for (const ros::Time& stamp : {stamps[1], stamps[5] + ros::Duration(0.01), nextStamp()}) {
    SetTarget::Request request = bottleRequest("left", leftBottle());
    request.stamp = stamp;
    const auto answer = client_.setTarget(request, cv::Mat());
    EXPECT_FALSE(answer.success);
    std::ostringstream held;
    held << "from " << stamps[2] << " to " << stamps[11];
    EXPECT_NE(answer.message.find(held.str()), std::string::npos) << answer.message;
  }
}

class PolygonTest : public SetTargetTest {
 protected:
  explicit PolygonTest(const std::string& tracker = "tracker",
                       const std::string& image_topic = "image")
      : SetTargetTest(tracker, image_topic),
        publisher_(ros::NodeHandle().advertise<geometry_msgs::PolygonStamped>(
            tracker + "/init_polygon", 1)) {}

  /// Whether the default object appears once the polygon was published.
  bool isTrackedAfter(const std::vector<cv::Point2d>& points, double seconds = kDeadline) {
    EXPECT_TRUE(waitUntil([this] { return publisher_.getNumSubscribers() > 0; }));
    geometry_msgs::PolygonStamped polygon;
    polygon.header.stamp = ros::Time(5.0);  // of a click: no image has it
    for (const auto& point : targetRequest("", points).points) {
      polygon.polygon.points.push_back(point);
    }
    publisher_.publish(polygon);
    return waitUntil([&] { return objectOf(client_.show(image_), "hand").has_value(); }, seconds);
  }

  ros::Publisher publisher_;
};

TEST_F(PolygonTest, TakesTheTwoEnds) {
  EXPECT_TRUE(isTrackedAfter(RenderedScene::endsOf(rightBottle())));
  EXPECT_TRUE(isAt(objectOf(client_.show(image_), "hand"), rightBottle()));
}

TEST_F(PolygonTest, TakesARectangleOpenOrClosed) {
  const std::vector<cv::Point2d> open = {{208, 65}, {252, 65}, {252, 175}, {208, 175}};
  EXPECT_TRUE(isTrackedAfter(open));
  EXPECT_TRUE(isAt(objectOf(client_.show(image_), "hand"), rightBottle()));
  client_.remove("hand");
  std::vector<cv::Point2d> closed = open;
  closed.push_back(open.front());
  EXPECT_TRUE(isTrackedAfter(closed));
  EXPECT_EQ(objectOf(client_.show(image_), "hand")->points.size(), 4u);
}

TEST_F(PolygonTest, AClosedOutlineOfFourNeedNotBeExact) {
  EXPECT_TRUE(isTrackedAfter({{200, 65}, {260, 70}, {245, 180}, {215, 172}, {202, 66}}));
  const auto object = objectOf(client_.show(image_), "hand");
  EXPECT_EQ(object->model, "box");
  EXPECT_EQ(object->points.size(), 4u);
}

/// A tracker whose default model is no rectangle.
class ContourTest : public PolygonTest {
 protected:
  ContourTest() : PolygonTest("contours", "contour_image") {}
};

TEST_F(ContourTest, KeepsTheLastPointOfAClosedContour) {
  EXPECT_TRUE(isTrackedAfter({{208, 65}, {252, 65}, {252, 175}, {208, 175}, {209, 66}}));
  const auto object = objectOf(client_.show(image_), "hand");
  EXPECT_EQ(object->model, "lips");
  EXPECT_EQ(object->points.size(), 5u);
}

TEST_F(PolygonTest, SurvivesNonsense) {
  EXPECT_FALSE(isTrackedAfter({{10, 10}}, 0.5));
  EXPECT_TRUE(isTrackedAfter(RenderedScene::endsOf(rightBottle())));
}

}  // namespace
}  // namespace chain_tracker

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "set_target_rostest");
  const ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
