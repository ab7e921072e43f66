// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/ros/target_registry.h"

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <ros/serialization.h>

#include "chain_tracker/chain/auto_model.h"
#include "chain_tracker/chain/chain_model_io.h"
#include "chain_tracker/evaluation/synthetic_scene.h"
#include "chain_tracker/ros/image_conversion.h"
#include "ros/rendered_scene.h"

namespace chain_tracker {
namespace {

const BottlePose kStart;  // where the bottle is unless it moves

class TargetRegistryTest : public testing::Test {
 protected:
  TargetRegistryTest()
      : model_(
            loadChainModel(std::string(CHAIN_TRACKER_SOURCE_DIR) + "/config/models/bottle.yaml")),
        history_(30) {}

  Frame receive(const cv::Mat& image, double stamp) {
    Frame frame{++frame_count_, imageMsg(image, ros::Time(stamp))};
    history_.add(frame);
    return frame;
  }

  FrameResult show(const cv::Mat& image, double stamp) {
    return registry_.process(receive(image, stamp), image);
  }

  /// Starts an object on the next frame; what the answer was is in the result.
  std::shared_ptr<std::optional<std::string>> expect(const std::string& id,
                                                     const std::vector<cv::Point2d>& points) {
    auto answer = std::make_shared<std::optional<std::string>>();
    registry_.startAtNextFrame({id, "bottle", points}, model_,
                               [answer](const std::string& refusal) { *answer = refusal; });
    return answer;
  }

  RenderedScene scene_;
  ChainModel model_;
  ImageHistory history_;
  TargetRegistry registry_;
  std::uint64_t frame_count_ = 0;
};

BottlePose movedBy(double x, double y) {
  BottlePose pose;
  pose.centre += cv::Point2d(x, y);
  return pose;
}

/// Two places for an object, of which the first, kStart, shows nothing at first.
struct DarkStart {
  RenderedScene scene{cv::Size(800, 240)};
  BottlePose elsewhere = movedBy(480.0, 0.0);

  cv::Mat bright() const { return scene.with({kStart, elsewhere}); }
  cv::Mat dark() const {
    cv::Mat image = bright();
    image.colRange(0, 400) = cv::Scalar();
    return image;
  }
};

void expectAt(const TrackedObject& object, const cv::Point2d& centre, double tolerance = 4.0) {
  EXPECT_NEAR(object.pose.x, centre.x, tolerance);
  EXPECT_NEAR(object.pose.y, centre.y, tolerance);
}

TEST_F(TargetRegistryTest, WithoutObjectsAFrameHasNone) {
  EXPECT_TRUE(show(scene_.wall(), 1.0).objects.empty());
}

TEST_F(TargetRegistryTest, AnObjectStartsOnTheNextFrameAndIsFollowed) {
  const auto answer = expect("a", RenderedScene::endsOf(kStart));
  EXPECT_FALSE(answer->has_value());
  FrameResult result = show(scene_.with({kStart}), 1.0);
  ASSERT_TRUE(answer->has_value());
  EXPECT_EQ(**answer, "");
  ASSERT_EQ(result.objects.size(), 1u);
  EXPECT_EQ(result.objects[0].state, TrackedObject::INITIALIZING);
  expectAt(result.objects[0], kStart.centre);
  for (const double step : {1.0, 2.0, 3.0, 4.0}) {
    const BottlePose pose = movedBy(5.0 * step, -2.0 * step);
    result = show(scene_.with({pose}), 1.0 + step);
    ASSERT_EQ(result.objects.size(), 1u);
    EXPECT_EQ(result.objects[0].state, TrackedObject::TRACKING);
    expectAt(result.objects[0], pose.centre);
  }
  EXPECT_TRUE(result.faults.empty());
}

TEST_F(TargetRegistryTest, ARefusedObjectIsToldAndTheOthersStay) {
  expect("good", RenderedScene::endsOf(kStart));
  show(scene_.with({kStart}), 1.0);
  const auto outside = expect("outside", {{1000.0, 50.0}, {1000.0, 150.0}});
  const auto replacing = expect("good", {{100.0, 50.0}, {100.0, 50.0}});
  const FrameResult result = show(scene_.with({kStart}), 2.0);
  EXPECT_NE(outside->value_or(""), "");
  EXPECT_NE(replacing->value_or(""), "");
  ASSERT_EQ(result.objects.size(), 1u);
  EXPECT_EQ(result.objects[0].id, "good");
  EXPECT_EQ(result.objects[0].state, TrackedObject::TRACKING);
}

TEST_F(TargetRegistryTest, AnExistingIdIsReplaced) {
  const BottlePose other = movedBy(-80.0, 0.0);
  const cv::Mat image = scene_.with({kStart, other});
  expect("a", RenderedScene::endsOf(kStart));
  show(image, 1.0);
  expect("a", RenderedScene::endsOf(other));
  const FrameResult result = show(image, 2.0);
  ASSERT_EQ(result.objects.size(), 1u);
  expectAt(result.objects[0], other.centre);
}

TEST_F(TargetRegistryTest, AWithdrawnObjectDoesNotStart) {
  const std::uint64_t ticket = registry_.startAtNextFrame(
      {"a", "bottle", RenderedScene::endsOf(kStart)}, model_,
      [](const std::string&) { ADD_FAILURE() << "withdrawn, yet answered"; });
  EXPECT_TRUE(registry_.withdraw(ticket));
  EXPECT_FALSE(registry_.withdraw(ticket));
  EXPECT_TRUE(show(scene_.with({kStart}), 1.0).objects.empty());
}

TEST_F(TargetRegistryTest, ClosingRefusesThoseThatWaitAndThoseThatCome) {
  const auto waiting = expect("a", RenderedScene::endsOf(kStart));
  registry_.close();
  EXPECT_NE(waiting->value_or(""), "");
  EXPECT_NE(expect("b", RenderedScene::endsOf(kStart))->value_or(""), "");
}

TEST_F(TargetRegistryTest, AnObjectStartedInThePastCatchesUp) {
  for (int k = 0; k < 6; ++k) show(scene_.with({movedBy(6.0 * k, 0.0)}), 1.0 + k);
  const Frame past = history_.at(ros::Time(2.0));
  registry_.startAt(past, {"a", "bottle", RenderedScene::endsOf(movedBy(6.0, 0.0))}, model_,
                    history_);
  const BottlePose now = movedBy(36.0, 0.0);
  const FrameResult result = show(scene_.with({now}), 7.0);
  ASSERT_EQ(result.objects.size(), 1u);
  EXPECT_EQ(result.objects[0].state, TrackedObject::TRACKING);
  expectAt(result.objects[0], now.centre);
}

TEST_F(TargetRegistryTest, AnObjectStartedAheadOfTheWorkerWaitsForItsFrame) {
  const Frame first = receive(scene_.with({kStart}), 1.0);
  const Frame second = receive(scene_.with({movedBy(6.0, 0.0)}), 2.0);
  registry_.startAt(second, {"a", "bottle", RenderedScene::endsOf(movedBy(6.0, 0.0))}, model_,
                    history_);
  EXPECT_TRUE(registry_.process(first, toBgr8(first.image)->image).objects.empty());
  const FrameResult result = registry_.process(second, toBgr8(second.image)->image);
  ASSERT_EQ(result.objects.size(), 1u);
  EXPECT_EQ(result.objects[0].state, TrackedObject::INITIALIZING);
}

TEST_F(TargetRegistryTest, AFaultyStartInThePastChangesNothing) {
  show(scene_.with({kStart}), 1.0);
  EXPECT_THROW(registry_.startAt(history_.at(ros::Time(1.0)), {"a", "bottle", {{5.0, 5.0}}}, model_,
                                 history_),
               std::invalid_argument);
  EXPECT_TRUE(show(scene_.with({kStart}), 2.0).objects.empty());
}

TEST_F(TargetRegistryTest, AnObjectWaitsForAFrameThatShowsAnything) {
  const cv::Mat black(scene_.wall().size(), CV_8UC3, cv::Scalar());
  const auto answer = expect("a", RenderedScene::endsOf(kStart));
  FrameResult result = show(black, 1.0);
  EXPECT_TRUE(result.objects.empty());
  ASSERT_EQ(result.faults.size(), 1u);
  EXPECT_NE(result.faults[0].reason.find("nothing to follow"), std::string::npos);
  EXPECT_FALSE(answer->has_value());
  result = show(scene_.with({kStart}), 2.0);
  EXPECT_TRUE(result.faults.empty());
  ASSERT_EQ(result.objects.size(), 1u);
  EXPECT_EQ(result.objects[0].state, TrackedObject::INITIALIZING);
  EXPECT_EQ(answer->value_or("not answered"), "");
}

TEST_F(TargetRegistryTest, ALaterStartReplacesOneThatStillWaits) {
  const DarkStart start;
  const auto first = expect("a", RenderedScene::endsOf(kStart));
  show(start.dark(), 1.0);
  EXPECT_FALSE(first->has_value());
  const auto second = expect("a", RenderedScene::endsOf(start.elsewhere));
  const FrameResult result = show(start.dark(), 2.0);
  EXPECT_EQ(first->value_or("still waits"), "it has been started otherwise meanwhile");
  EXPECT_EQ(second->value_or("still waits"), "");
  EXPECT_TRUE(result.faults.empty());
  expectAt(show(start.bright(), 3.0).objects.at(0), start.elsewhere.centre);
}

TEST_F(TargetRegistryTest, AStartInThePastReplacesOneThatStillWaits) {
  const DarkStart start;
  const auto first = expect("a", RenderedScene::endsOf(kStart));
  const Frame past = receive(start.dark(), 1.0);
  registry_.process(past, start.dark());
  EXPECT_FALSE(first->has_value());
  registry_.startAt(past, {"a", "bottle", RenderedScene::endsOf(start.elsewhere)}, model_,
                    history_);
  EXPECT_EQ(first->value_or("still waits"), "it has been started otherwise meanwhile");
  expectAt(show(start.bright(), 2.0).objects.at(0), start.elsewhere.centre);
}

TEST_F(TargetRegistryTest, AnObjectThatWaitsCanBeRemoved) {
  const auto answer = expect("a", RenderedScene::endsOf(kStart));
  const auto other = expect("b", RenderedScene::endsOf(kStart));
  EXPECT_TRUE(registry_.remove("a"));
  EXPECT_FALSE(registry_.remove("a"));
  EXPECT_EQ(answer->value_or(""), "it has been removed");
  const FrameResult result = show(scene_.with({kStart}), 1.0);
  ASSERT_EQ(result.objects.size(), 1u);
  EXPECT_EQ(result.objects[0].id, "b");
  EXPECT_EQ(other->value_or("still waits"), "");
}

TEST_F(TargetRegistryTest, AWithdrawnObjectTellsWhyItWaited) {
  const cv::Mat black(scene_.wall().size(), CV_8UC3, cv::Scalar());
  const std::uint64_t ticket = registry_.startAtNextFrame(
      {"a", "bottle", RenderedScene::endsOf(kStart)}, model_, [](const std::string&) {});
  show(black, 1.0);
  EXPECT_NE(registry_.withdraw(ticket).value_or("").find("nothing to follow"), std::string::npos);
}

TEST_F(TargetRegistryTest, ARemovedObjectIsGone) {
  expect("a", RenderedScene::endsOf(kStart));
  show(scene_.with({kStart}), 1.0);
  EXPECT_TRUE(registry_.remove("a"));
  EXPECT_FALSE(registry_.remove("a"));
  EXPECT_TRUE(show(scene_.with({kStart}), 2.0).objects.empty());
}

TEST_F(TargetRegistryTest, RestartedObjectsStartFromThePointsGiven) {
  expect("a", RenderedScene::endsOf(kStart));
  for (int k = 0; k < 5; ++k) show(scene_.with({movedBy(8.0 * k, 0.0)}), 1.0 + k);
  EXPECT_EQ(registry_.restartAll(), 1u);
  FrameResult result = show(scene_.with({kStart}), 6.0);
  ASSERT_EQ(result.objects.size(), 1u);
  EXPECT_EQ(result.objects[0].state, TrackedObject::INITIALIZING);
  expectAt(result.objects[0], kStart.centre, 1.0);
  result = show(scene_.with({kStart}), 7.0);
  EXPECT_EQ(result.objects[0].state, TrackedObject::TRACKING);
}

TEST_F(TargetRegistryTest, TimeGoingBackRestartsOnce) {
  expect("a", RenderedScene::endsOf(kStart));
  for (int k = 0; k < 5; ++k) show(scene_.with({movedBy(8.0 * k, 0.0)}), 10.0 + k);
  FrameResult result = show(scene_.with({kStart}), 10.0);
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_NE(result.notes[0].find("time went back from 14.000000000 to 10.000000000"),
            std::string::npos);
  EXPECT_EQ(result.objects.at(0).state, TrackedObject::INITIALIZING);
  result = show(scene_.with({kStart}), 11.0);
  EXPECT_TRUE(result.notes.empty());
  EXPECT_EQ(result.objects.at(0).state, TrackedObject::TRACKING);
}

TEST_F(TargetRegistryTest, EqualStampsAreNotTimeGoingBack) {
  expect("a", RenderedScene::endsOf(kStart));
  show(scene_.with({kStart}), 0.0);
  const FrameResult result = show(scene_.with({kStart}), 0.0);
  EXPECT_TRUE(result.notes.empty());
  EXPECT_EQ(result.objects.at(0).state, TrackedObject::TRACKING);
}

TEST_F(TargetRegistryTest, AnotherSizeStartsAgainWhereTheObjectIs) {
  expect("a", RenderedScene::endsOf(kStart));
  const BottlePose moved = movedBy(24.0, 8.0);
  for (int k = 0; k <= 4; ++k) show(scene_.with({movedBy(6.0 * k, 2.0 * k)}), 1.0 + k);
  cv::Mat twice;
  cv::resize(scene_.with({moved}), twice, cv::Size(), 2.0, 2.0);
  FrameResult result = show(twice, 6.0);
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_NE(result.notes[0].find("from [320 x 240] to [640 x 480] px"), std::string::npos);
  expectAt(result.objects.at(0), 2.0 * moved.centre, 8.0);
  result = show(twice, 7.0);
  EXPECT_TRUE(result.notes.empty());
  EXPECT_EQ(result.objects.at(0).state, TrackedObject::TRACKING);
}

TEST_F(TargetRegistryTest, PartsAreAsManyAsAnotherSizeHasRoomFor) {
  const SceneFrame scene = makeScene("cable", SceneOptions())->render(0);
  const ChainModel cable = withRoomForParts(
      loadChainModel(std::string(CHAIN_TRACKER_SOURCE_DIR) + "/config/models/cable.yaml"),
      scene.points);
  registry_.startAtNextFrame({"a", "cable", scene.points}, cable, [](const std::string&) {});
  const auto all = static_cast<std::size_t>(cable.segments[0].parts);
  EXPECT_EQ(show(scene.image, 1.0).objects.at(0).parts.size(), all);
  cv::Mat half;
  cv::resize(scene.image, half, cv::Size(), 0.5, 0.5, cv::INTER_AREA);
  const FrameResult small = show(half, 2.0);
  EXPECT_TRUE(small.faults.empty()) << small.faults[0].reason;
  EXPECT_LT(small.objects.at(0).parts.size(), all);
  EXPECT_EQ(show(half, 3.0).objects.at(0).state, TrackedObject::TRACKING);
  registry_.restartAll();
  EXPECT_EQ(show(half, 4.0).objects.at(0).state, TrackedObject::INITIALIZING);
  EXPECT_EQ(show(scene.image, 5.0).objects.at(0).parts.size(), all);
}

TEST_F(TargetRegistryTest, ThePointsGivenAreScaledWithTheImage) {
  expect("a", RenderedScene::endsOf(kStart));
  show(scene_.with({kStart}), 1.0);
  cv::Mat twice;
  cv::resize(scene_.with({kStart}), twice, cv::Size(), 2.0, 2.0);
  show(twice, 2.0);
  registry_.restartAll();
  const FrameResult result = show(twice, 3.0);
  ASSERT_EQ(result.objects.size(), 1u);
  ASSERT_EQ(result.objects[0].points.size(), 2u);
  // Pixel 0 of the small image covers the pixels 0 and 1 of the large one: 0 -> 0.5.
  const cv::Point2d first = RenderedScene::endsOf(kStart)[0];
  EXPECT_NEAR(result.objects[0].points[0].x, 2.0 * first.x + 0.5, 1e-3);
  EXPECT_NEAR(result.objects[0].points[0].y, 2.0 * first.y + 0.5, 1e-3);
}

TEST_F(TargetRegistryTest, StampsOutOfOrderOrMissingAreNotTimeGoingBack) {
  expect("a", RenderedScene::endsOf(kStart));
  for (int k = 0; k < 5; ++k) show(scene_.with({movedBy(4.0 * k, 0.0)}), 10.0 + k);
  for (const double stamp : {13.9, 13.6, 0.0, 15.0}) {
    const FrameResult result = show(scene_.with({movedBy(16.0, 0.0)}), stamp);
    EXPECT_TRUE(result.notes.empty()) << stamp;
    EXPECT_EQ(result.objects.at(0).state, TrackedObject::TRACKING) << stamp;
  }
}

TEST_F(TargetRegistryTest, AnObjectThatCannotStartAgainIsTriedAgain) {
  expect("a", RenderedScene::endsOf(kStart));
  show(scene_.with({kStart}), 1.0);
  registry_.restartAll();
  FrameResult result = show(cv::Mat(scene_.wall().size(), CV_8UC3, cv::Scalar()), 2.0);
  ASSERT_EQ(result.faults.size(), 1u);
  EXPECT_NE(result.faults[0].reason.find("cannot start again"), std::string::npos);
  EXPECT_EQ(result.objects.at(0).state, TrackedObject::LOST);
  EXPECT_EQ(result.objects.at(0).confidence, 0.0f);
  result = show(scene_.with({kStart}), 3.0);
  EXPECT_TRUE(result.faults.empty());
  EXPECT_EQ(result.objects.at(0).state, TrackedObject::INITIALIZING);
}

TEST_F(TargetRegistryTest, ALostObjectOutlivesAnotherSize) {
  expect("a", RenderedScene::endsOf(kStart));
  show(scene_.with({kStart}), 1.0);
  FrameResult result;
  for (int k = 0; k < 10; ++k) result = show(scene_.wall(), 2.0 + k);
  ASSERT_EQ(result.objects.at(0).state, TrackedObject::LOST);
  cv::Mat twice;
  cv::resize(scene_.wall(), twice, cv::Size(), 2.0, 2.0);
  result = show(twice, 20.0);
  EXPECT_EQ(result.objects.at(0).state, TrackedObject::LOST);
  ASSERT_EQ(result.faults.size(), 1u);
  EXPECT_EQ(result.faults[0].id, "a");
  EXPECT_NE(result.faults[0].reason.find("old size"), std::string::npos);
  for (int k = 0; k < 4; ++k) result = show(scene_.with({kStart}), 21.0 + k);
  expectAt(result.objects.at(0), kStart.centre, 8.0);
}

/// Bytes, for numbers that are none equal nothing.
std::string bytesOf(const TrackedObject& object) {
  const ros::SerializedMessage message = ros::serialization::serializeMessage(object);
  return {message.buf.get(), message.buf.get() + message.num_bytes};
}

/// Of bottles, of which the last of three leaves: what 12 frames brought.
std::vector<FrameResult> trackedBy(int threads, size_t bottles) {
  const ChainModel model =
      loadChainModel(std::string(CHAIN_TRACKER_SOURCE_DIR) + "/config/models/bottle.yaml");
  const RenderedScene scene(cv::Size(640, 480));
  TargetRegistry registry;
  registry.useThreads(threads);
  const auto at = [](double x, double y) { return BottlePose{{x, y}, 1.5}; };
  const std::vector<std::pair<std::string, BottlePose>> starts = {
      {"a", at(120, 120)}, {"b", at(320, 240)}, {"c", at(520, 360)}};
  for (size_t i = 0; i < bottles; ++i) {
    const auto& [id, pose] = starts[i];
    registry.startAtNextFrame({id, "bottle", RenderedScene::endsOf(pose)}, model,
                              [](const std::string&) {});
  }
  std::vector<FrameResult> results;
  for (std::uint64_t k = 0; k < 12; ++k) {
    const auto step = static_cast<double>(k);
    std::vector<BottlePose> poses = {at(120 + 4 * step, 120), at(320, 240 - 3 * step)};
    if (k < 4) poses.push_back(at(520 - 2 * step, 360));
    if (k == 9) registry.restartAll();
    const cv::Mat image = scene.with(poses);
    results.push_back(registry.process({k + 1, imageMsg(image, ros::Time(1.0 + step))}, image));
  }
  return results;
}

/// One bottle has all threads, three have one each.
TEST(TargetRegistryThreads, ChangeNothing) {
  for (const size_t bottles : {1u, 3u}) {
    SCOPED_TRACE(std::to_string(bottles) + " bottles");
    const std::vector<FrameResult> alone = trackedBy(1, bottles);
    const std::vector<FrameResult> together = trackedBy(3, bottles);
    for (size_t k = 0; k < alone.size(); ++k) {
      ASSERT_EQ(alone[k].objects.size(), bottles) << k;
      ASSERT_EQ(together[k].objects.size(), bottles) << k;
      for (size_t i = 0; i < bottles; ++i) {
        EXPECT_EQ(bytesOf(alone[k].objects[i]), bytesOf(together[k].objects[i])) << k << " " << i;
      }
      EXPECT_EQ(alone[k].notes, together[k].notes) << k;
    }
    ASSERT_EQ(alone[9].notes.size(), bottles);
    for (size_t i = 0; i < bottles; ++i) {
      EXPECT_EQ(alone[9].notes[i].find("'" + alone[9].objects[i].id + "'"), 0u);
    }
  }
}

}  // namespace
}  // namespace chain_tracker
