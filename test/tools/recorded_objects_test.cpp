// SPDX-License-Identifier: BSD-3-Clause
#include "tools/common/recorded_objects.h"

#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rosbag/bag.h>

#include "chain_tracker/TrackedObjectArray.h"
#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/object_shape.h"
#include "chain_tracker/ros/msg_conversion.h"
#include "support/refusal.h"

namespace chain_tracker {
namespace {

const cv::Size kImage(640, 480);

/// What a tracker knows of an object of one segment that was started as `layout` says.
ChainState stateOf(const SegmentLayout& layout, const Similarity& pose, TrackingStatus status) {
  ChainState state;
  state.status = status;
  state.confidence = 0.75;
  SegmentState segment;
  segment.name = "body";
  segment.image_from_segment = pose;
  segment.part_count = static_cast<int>(layout.parts.size());
  for (const PartLayout& part : layout.parts) {
    PartState moved;
    moved.position = pose.apply(part.position);
    moved.orientation = pose.angle;
    moved.side = part.side * pose.scale;
    moved.visible = true;
    state.parts.push_back(moved);
  }
  state.segments = {segment};
  ObjectShape({layout}).carry(state);
  return state;
}

/// A rectangle of 80 x 30 px about (200, 150), turned by `angle`.
SegmentLayout rectangle(double angle) {
  SegmentLayout layout;
  layout.layout = Layout::kPlanar;
  layout.image_from_segment = {angle, 1.0, {200.0, 150.0}};
  layout.corners = {{-40, -15}, {40, -15}, {40, 15}, {-40, 15}};
  layout.points = layout.corners;
  layout.parts = {{{-20, 0}, 30.0}, {{20, 0}, 30.0}};
  return layout;
}

/// A bent line whose box is not centred on the mean of its parts.
SegmentLayout bentLine() {
  SegmentLayout layout;
  layout.layout = Layout::kDeformable;
  layout.image_from_segment = {0.4, 1.0, {200.0, 150.0}};
  for (const cv::Point2d& corner : {cv::Point2d(150, 120), cv::Point2d(290, 120),
                                    cv::Point2d(290, 170), cv::Point2d(150, 170)}) {
    layout.corners.push_back(layout.image_from_segment.applyInverse(corner));
  }
  layout.points = {{-50, 0}, {90, 10}};
  layout.parts = {{{-50, 0}, 20.0}, {{0, 5}, 20.0}, {{90, 10}, 20.0}};
  return layout;
}

Similarity moved(const SegmentLayout& layout) {
  Similarity pose = layout.image_from_segment;
  pose.angle += 0.6;
  pose.scale = 1.3;
  pose.translation += cv::Point2d(35.0, -20.0);
  return pose;
}

void expectSameBox(const cv::Rect2d& a, const cv::Rect2d& b) {
  EXPECT_NEAR(a.x, b.x, 1e-3);
  EXPECT_NEAR(a.y, b.y, 1e-3);
  EXPECT_NEAR(a.width, b.width, 1e-3);
  EXPECT_NEAR(a.height, b.height, 1e-3);
}

TEST(BoxOf, IsTheTrackersBox) {
  for (const SegmentLayout& layout :
       {rectangle(0.0), rectangle(CV_PI / 2.0), rectangle(0.5), bentLine()}) {
    SCOPED_TRACE(layout.image_from_segment.angle);
    const ChainState first =
        stateOf(layout, layout.image_from_segment, TrackingStatus::kInitializing);
    const ChainState later = stateOf(layout, moved(layout), TrackingStatus::kTracking);
    expectSameBox(boxOf(toMsg(first, "a", "box", kImage)), first.box);
    expectSameBox(boxOf(toMsg(later, "a", "box", kImage)), later.box);
  }
}

TEST(BoxOf, ALostObjectIsEmpty) {
  const SegmentLayout layout = rectangle(0.0);
  const ChainState lost = stateOf(layout, moved(layout), TrackingStatus::kLost);
  EXPECT_TRUE(boxOf(toMsg(lost, "a", "box", kImage)).empty());
}

/// A bag of messages, one for each frame at 0.1 s.
class Recordings : public testing::Test {
 protected:
  Recordings()
      : path_(
            (std::filesystem::path(testing::TempDir()) /
             (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".bag"))
                .string()) {
    bag_.open(path_, rosbag::bagmode::Write);
  }
  ~Recordings() override { std::filesystem::remove(path_); }

  static ros::Time stampOf(int frame) { return ros::Time(100.0) + ros::Duration(0.1 * frame); }

  static std::map<ros::Time, int> indexOf(int frames) {
    std::map<ros::Time, int> index_of;
    for (int frame = 0; frame < frames; ++frame) index_of[stampOf(frame)] = frame;
    return index_of;
  }

  static TrackedObject object(const std::string& id, TrackingStatus status) {
    const SegmentLayout layout = rectangle(0.0);
    return toMsg(stateOf(layout, layout.image_from_segment, status), id, "box", kImage);
  }

  void add(const ros::Time& stamp, const std::vector<TrackedObject>& objects) {
    TrackedObjectArray array;
    array.header.stamp = stamp;
    array.objects = objects;
    array.processing_time = ros::Duration(0.004);
    bag_.write("/objects", stamp, array);
  }

  ObjectRecording read(int frames, const std::string& id = "") {
    bag_.close();
    return readRecording(path_, "/objects", indexOf(frames), id);
  }

  std::string path_;
  rosbag::Bag bag_;
};

TEST_F(Recordings, AreMatchedByStampAndMissWhatWasDropped) {
  add(stampOf(0), {object("a", TrackingStatus::kInitializing)});
  add(stampOf(1), {object("a", TrackingStatus::kTracking)});
  add(stampOf(4), {object("a", TrackingStatus::kLost)});  // 2 and 3 were dropped
  add(stampOf(4) + ros::Duration(0.05), {object("a", TrackingStatus::kTracking)});
  const ObjectRecording recording = read(6);
  EXPECT_EQ(recording.id, "a");
  EXPECT_EQ(recording.model, "box");
  EXPECT_EQ(recording.without_image, 1);
  ASSERT_EQ(recording.frames.size(), 3U);
  for (const int frame : {0, 1, 4}) EXPECT_EQ(recording.frames.count(frame), 1U) << frame;
  const RecordedFrame& second = recording.frames.at(1);
  EXPECT_DOUBLE_EQ(second.time_ms, 4.0);
  EXPECT_EQ(second.tracked.state, "TRACKING");
  EXPECT_DOUBLE_EQ(second.tracked.confidence, 0.75);
  EXPECT_DOUBLE_EQ(second.tracked.scale, 1.0);
  expectSameBox(second.tracked.box, {160, 135, 80, 30});
  ASSERT_EQ(second.tracked.outline.size(), 4U);
  EXPECT_EQ(second.tracked.outline[2], cv::Point2d(240, 165));
  ASSERT_EQ(second.tracked.points.size(), 4U);
  EXPECT_EQ(second.tracked.points[2].position, cv::Point2d(240, 165));
  ASSERT_EQ(second.tracked.parts.size(), 2U);
  EXPECT_EQ(second.tracked.parts[1].position, cv::Point2d(220, 150));
  EXPECT_TRUE(recording.frames.at(4).tracked.lost);
}

TEST_F(Recordings, FollowTheObjectThatCameFirst) {
  add(stampOf(0), {});
  add(stampOf(1), {object("b", TrackingStatus::kInitializing)});
  add(stampOf(2),
      {object("a", TrackingStatus::kInitializing), object("b", TrackingStatus::kTracking)});
  add(stampOf(3), {object("a", TrackingStatus::kTracking)});
  const ObjectRecording recording = read(4);
  EXPECT_EQ(recording.id, "b");
  EXPECT_EQ(recording.frames.size(), 2U);
  EXPECT_EQ(recording.frames.at(2).tracked.state, "TRACKING");
  EXPECT_EQ(recording.frames_without_object, (std::vector<int>{0, 3}));
}

TEST_F(Recordings, MayHoldSeveralObjects) {
  for (const int frame : {0, 1}) {
    add(stampOf(frame), {object("apple", TrackingStatus::kTracking)});
  }
  add(stampOf(2),
      {object("apple", TrackingStatus::kTracking), object("zebra", TrackingStatus::kTracking)});
  const ObjectRecording recording = read(3, "zebra");
  EXPECT_EQ(recording.id, "zebra");
  EXPECT_EQ(recording.ids, (std::set<std::string>{"apple", "zebra"}));
  EXPECT_EQ(namesOf(recording.ids), "'apple', 'zebra'");
  EXPECT_EQ(recording.frames.size(), 1U);
  EXPECT_EQ(recording.frames.count(2), 1U);
  EXPECT_EQ(recording.frames_without_object, (std::vector<int>{0, 1}));
}

TEST_F(Recordings, AMissingObjectIsRefusedWithThoseThatAre) {
  add(stampOf(0),
      {object("apple", TrackingStatus::kTracking), object("zebra", TrackingStatus::kTracking)});
  EXPECT_EQ(omissionsOf(refusalOf([&] { read(1, "yak"); }),
                        {path_ + ": no message on /objects tells of 'yak', only of 'apple', "
                                 "'zebra'"}),
            "");
}

TEST_F(Recordings, WithoutObjectsAreRefusedForAnyId) {
  add(stampOf(0), {});
  EXPECT_EQ(omissionsOf(refusalOf([&] { read(1, "yak"); }), {"tells of 'yak', nor of any object"}),
            "");
}

TEST_F(Recordings, ServeAsTruth) {
  add(stampOf(0), {object("a", TrackingStatus::kInitializing)});
  add(stampOf(1), {object("a", TrackingStatus::kLost)});
  add(stampOf(2), {});
  const GroundTruth truth = truthFrom(read(3));
  ASSERT_TRUE(truth.boxes.at(0));
  expectSameBox(*truth.boxes.at(0), {160, 135, 80, 30});
  EXPECT_EQ(truth.points.at(0).at(1).position, cv::Point2d(240, 135));
  EXPECT_EQ(truth.boxes.count(1), 0U) << "whoever lost it does not know";
  EXPECT_FALSE(truth.boxes.at(2)) << "it is not there";
  EXPECT_EQ(truth.points.size(), 1U);
}

TEST_F(Recordings, AMissingTopicIsRefusedWithThoseThatAre) {
  add(stampOf(0), {object("a", TrackingStatus::kTracking)});
  bag_.close();
  EXPECT_EQ(omissionsOf(refusalOf([&] { readRecording(path_, "/nope", indexOf(1), ""); }),
                        {path_, "'/nope'", "chain_tracker/TrackedObjectArray", "/objects"}),
            "");
}

}  // namespace
}  // namespace chain_tracker
