// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/evaluation/evaluation_run.h"

#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/refusal.h"

namespace chain_tracker {
namespace {

/// Frames of which some cannot be read and some have another size.
class FakeSource : public FrameSource {
 public:
  explicit FakeSource(int count, std::set<int> unreadable = {}, std::set<int> small = {})
      : count_(count), unreadable_(std::move(unreadable)), small_(std::move(small)) {}

  bool next(SourceFrame& frame) override {
    if (next_ == count_) return false;
    const bool bad = unreadable_.count(next_) != 0;
    const int width = small_.count(next_) != 0 ? 20 : 40;
    frame = {next_, next_ / 30.0, bad ? cv::Mat() : cv::Mat(30, width, CV_8UC3),
             bad ? "frame " + std::to_string(next_) + " is broken" : ""};
    ++next_;
    return true;
  }
  int count() const override { return count_; }

 private:
  int count_;
  std::set<int> unreadable_;
  std::set<int> small_;
  int next_ = 0;
};

TrackedFrame at(double x) {
  TrackedFrame frame;
  frame.state = "TRACKING";
  frame.box = {x, 0.0, 10.0, 10.0};
  frame.points = {{{x, 5.0}, 1.0, true}, {{x + 10.0, 5.0}, 1.0, true}};
  return frame;
}

TrackedFrame lost() {
  TrackedFrame frame = at(0.0);
  frame.state = "LOST";
  frame.lost = true;
  return frame;
}

/// Reports what it was told to, one frame after another; fails where that is nothing.
class FakeTracker : public EvaluatedTracker {
 public:
  FakeTracker(std::string name, std::vector<std::optional<TrackedFrame>> reports)
      : name_(std::move(name)), reports_(std::move(reports)) {}

  std::string name() const override { return name_; }
  TrackedFrame start(const cv::Mat& image) override {
    ++starts_;
    return update(image);
  }
  TrackedFrame update(const cv::Mat&) override {
    const auto& report = reports_.at(next_++);
    if (!report) throw std::invalid_argument("cannot");
    return *report;
  }
  int starts() const { return starts_; }

 private:
  std::string name_;
  std::vector<std::optional<TrackedFrame>> reports_;
  std::size_t next_ = 0;
  int starts_ = 0;
};

using Trackers = std::vector<std::unique_ptr<EvaluatedTracker>>;

Trackers only(std::vector<std::optional<TrackedFrame>> reports) {
  Trackers trackers;
  trackers.push_back(std::make_unique<FakeTracker>("fake", std::move(reports)));
  return trackers;
}

GroundTruth boxesAt0(const std::set<int>& frames) {
  GroundTruth truth;
  for (const int frame : frames) truth.boxes[frame] = cv::Rect2d(0, 0, 10, 10);
  return truth;
}

const std::vector<cv::Point2d> kStart = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};

/// The points that at() carries.
const std::vector<cv::Point2d> kEnds = {{0, 5}, {10, 5}};

EvaluationResult run(FakeSource source, const Trackers& trackers, const GroundTruth& truth,
                     const EvaluationOptions& options = EvaluationOptions(),
                     const std::vector<cv::Point2d>& start = kStart) {
  return evaluate(source, trackers, truth, start, options);
}

/// Three parts in two frames, and a box of its own in the first.
GroundTruth threeParts() {
  GroundTruth truth = boxesAt0({0});
  truth.points[0] = {{0, {{0, 5}, true}}, {1, {{5, 5}, true}}, {2, {{10, 5}, true}}};
  truth.points[1] = {{0, {{0, 0}, true}}, {1, {{5, 10}, true}}, {2, {{10, 0}, false}}};
  return truth;
}

void expectBoxesScoredOnly(const EvaluationResult& result) {
  const TrackerRun& run = result.runs.front();
  EXPECT_TRUE(std::isnan(run.scores.part_error_mean_px));
  EXPECT_TRUE(std::isnan(run.scores.pck_10));
  EXPECT_DOUBLE_EQ(run.frames[0].score.overlap, 1.0);
  ASSERT_TRUE(run.frames[1].score.has_object) << "of two points seen";
  // The box at 0 to 10 of the tracker, and -0.25 to 5.25 by -0.5 to 10.5 of the points.
  EXPECT_NEAR(run.frames[1].score.overlap, 52.5 / (100.0 + 60.5 - 52.5), 1e-9);
  ASSERT_EQ(result.faults.size(), 1U);
  EXPECT_EQ(result.faults[0],
            "points are not scored, only boxes: the object is given by 2 points, must be by the 3 "
            "parts of the ground truth");
}

TEST(EvaluationRun, KnownBoxesGetKnownScores) {
  // 5 px beside: 50 of 150 px^2 in common.
  const auto result = run(FakeSource(3), only({at(0.0), at(5.0), at(25.0)}), boxesAt0({0, 1, 2}));
  const Scores& scores = result.runs.front().scores;
  EXPECT_EQ(scores.frames, 3);
  EXPECT_EQ(scores.scored_frames, 3);
  EXPECT_DOUBLE_EQ(scores.mean_iou, (1.0 + 1.0 / 3.0) / 3.0);
  EXPECT_DOUBLE_EQ(scores.pascal_50, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(scores.mean_center_error_px, 10.0);
  EXPECT_DOUBLE_EQ(scores.precision_20px, 2.0 / 3.0);
  EXPECT_TRUE(std::isnan(scores.pck_10)) << "there are no true points";
}

TEST(EvaluationRun, WhereTheTruthTurnsTheBoundsOfTheOutlineAreScored) {
  TrackedFrame turned = at(0.0);
  turned.box = {5.0, 0.0, 10.0, 10.0};
  turned.outline = {{5, 0}, {10, 5}, {5, 10}, {0, 5}};
  GroundTruth truth = boxesAt0({0, 1});
  const auto overlaps = [&] {
    const auto result = run(FakeSource(2), only({turned, at(0.0)}), truth);
    const std::vector<EvaluatedFrame>& frames = result.runs.front().frames;
    return std::make_pair(frames[0].score.overlap, frames[1].score.overlap);
  };
  EXPECT_NEAR(overlaps().first, 1.0 / 3.0, 1e-9);
  truth.boxes_turn = true;
  EXPECT_DOUBLE_EQ(overlaps().first, 1.0);
  EXPECT_DOUBLE_EQ(overlaps().second, 1.0) << "a tracker without outlines has its box";
}

TEST(EvaluationRun, ALostFrameIsNoOverlap) {
  const auto result = run(FakeSource(3), only({at(0.0), lost(), at(0.0)}), boxesAt0({0, 1, 2}));
  const Scores& scores = result.runs.front().scores;
  EXPECT_DOUBLE_EQ(scores.mean_iou, 2.0 / 3.0);
  EXPECT_EQ(scores.lost_frames, 1);
  EXPECT_EQ(scores.reacquired, 1);
}

TEST(EvaluationRun, AFrameWithoutTruthDoesNotCount) {
  const auto result = run(FakeSource(3), only({at(0.0), at(25.0), at(5.0)}), boxesAt0({0, 2}));
  const Scores& scores = result.runs.front().scores;
  EXPECT_EQ(scores.frames, 3);
  EXPECT_EQ(scores.scored_frames, 2);
  EXPECT_DOUBLE_EQ(scores.mean_iou, (1.0 + 1.0 / 3.0) / 2.0);
}

TEST(EvaluationRun, AFrameWithoutAnObjectDoesNotCount) {
  GroundTruth truth = boxesAt0({0, 2});
  truth.boxes[1] = std::nullopt;
  const auto result = run(FakeSource(3), only({at(0.0), lost(), at(0.0)}), truth);
  EXPECT_DOUBLE_EQ(result.runs.front().scores.mean_iou, 1.0);
  EXPECT_EQ(result.runs.front().scores.lost_frames, 0);
}

TEST(EvaluationRun, PointsAreScoredOneByOneAndAsTheirBox) {
  GroundTruth truth;
  truth.points[0] = {{0, {{0, 5}, true}}, {1, {{10, 5}, true}}};
  truth.points[1] = {{0, {{0, 2}, true}}, {1, {{10, 5}, false}}};
  const auto result = run(FakeSource(2), only({at(0.0), at(0.0)}), truth, {}, kEnds);
  EXPECT_TRUE(result.faults.empty());
  const auto& frames = result.runs.front().frames;
  EXPECT_EQ(frames[0].score.point_errors, (std::vector<double>{0.0, 0.0}));
  EXPECT_DOUBLE_EQ(frames[0].score.overlap, 1.0) << "the same points, the same box around them";
  EXPECT_EQ(frames[1].score.point_errors, std::vector<double>{3.0}) << "a hidden one is not asked";
  EXPECT_EQ(frames[0].score.hidden_points, 0);
  EXPECT_EQ(frames[1].score.hidden_points, 1);
  EXPECT_FALSE(frames[1].score.has_object) << "one point has no box";
  EXPECT_DOUBLE_EQ(result.runs.front().scores.part_error_mean_px, 1.0);
}

TEST(EvaluationRun, PointsOfAnotherNumberThanThePartsAreNotScored) {
  expectBoxesScoredOnly(
      run(FakeSource(2), only({at(0.0), at(0.0)}), threeParts(), EvaluationOptions(), kEnds));
}

TEST(EvaluationRun, BoxesTurnWhereOnlyTheyAreScored) {
  TrackedFrame turned = at(0.0);
  turned.box = {5.0, 0.0, 10.0, 10.0};
  turned.outline = {{5, 0}, {10, 5}, {5, 10}, {0, 5}};
  GroundTruth truth = threeParts();
  truth.boxes_turn = true;
  const auto result = run(FakeSource(1), only({turned}), truth, EvaluationOptions(), kEnds);
  EXPECT_DOUBLE_EQ(result.runs.front().frames.front().score.overlap, 1.0);
}

TEST(EvaluationRun, BoxAroundPointsIsATenthLarger) {
  const cv::Rect2d box = boxAround({{0, 0}, {100, 50}});
  EXPECT_NEAR(box.x, -5.0, 1e-9);
  EXPECT_NEAR(box.y, -2.5, 1e-9);
  EXPECT_NEAR(box.width, 110.0, 1e-9);
  EXPECT_NEAR(box.height, 55.0, 1e-9);
  const cv::Rect2d flat = boxAround({{0, 7}, {100, 7}});
  EXPECT_NEAR(flat.y, 6.5, 1e-9);
  EXPECT_NEAR(flat.height, 1.0, 1e-9);
}

TEST(EvaluationRun, LengthOfAShape) {
  EXPECT_DOUBLE_EQ(objectLength({{0, 0}, {30, 0}, {30, 40}}, false), 70.0);
  EXPECT_DOUBLE_EQ(objectLength({{0, 0}, {30, 0}, {30, 40}, {0, 40}}, true), 50.0);
}

TEST(EvaluationRun, UnreadableFramesAreSkippedAndTold) {
  const auto result = run(FakeSource(3, {1}), only({at(0.0), at(0.0)}), boxesAt0({0, 1, 2}));
  EXPECT_EQ(result.skipped_frames, 1);
  ASSERT_EQ(result.faults.size(), 1U);
  EXPECT_EQ(result.faults[0], "skipped a frame: frame 1 is broken");
  ASSERT_EQ(result.runs.front().frames.size(), 2U);
  EXPECT_EQ(result.runs.front().frames[1].index, 2);
}

TEST(EvaluationRun, FramesOfAnotherSizeAreSkippedAndTold) {
  const auto result = run(FakeSource(3, {}, {2}), only({at(0.0), at(0.0)}), boxesAt0({0, 1, 2}));
  EXPECT_EQ(result.skipped_frames, 1);
  EXPECT_NE(result.faults.at(0).find("frame 2 has another size"), std::string::npos);
}

TEST(EvaluationRun, TheFrameThatTheObjectIsGivenInMustBeReadable) {
  EvaluationOptions options;
  EXPECT_EQ(omissionsOf(refusalOf([&] {
                          run(FakeSource(3, {0}), only({at(0.0), at(0.0)}), boxesAt0({0}), options);
                        }),
                        {"frame 0, in which the object is given", "frame 0 is broken"}),
            "");
  options.first_frame = 1;
  const auto result = run(FakeSource(3, {0}), only({at(0.0), at(0.0)}), boxesAt0({1}), options);
  EXPECT_EQ(result.runs.front().frames.front().index, 1);
  EXPECT_EQ(result.skipped_frames, 0) << "no one asked for it";
  options.first_frame = 3;
  EXPECT_EQ(omissionsOf(refusalOf([&] { run(FakeSource(3), only({}), boxesAt0({0}), options); }),
                        {"in frame 3", "of only 3"}),
            "");
}

TEST(EvaluationRun, MaxFramesCountsFromTheFirst) {
  EvaluationOptions options;
  options.first_frame = 2;
  options.max_frames = 2;
  const auto result = run(FakeSource(9), only({at(0.0), at(0.0)}), boxesAt0({2, 3, 4}), options);
  ASSERT_EQ(result.runs.front().frames.size(), 2U);
  EXPECT_EQ(result.runs.front().frames.back().index, 3);
}

TEST(EvaluationRun, AnInterruptedRunKeepsItsFrames) {
  EvaluationOptions options;
  int asked = 0;
  options.interrupted = [&] { return ++asked > 2; };
  const auto result = run(FakeSource(9), only({at(0.0), at(0.0)}), boxesAt0({0, 1}), options);
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(result.runs.front().frames.size(), 2U);
  EXPECT_DOUBLE_EQ(result.runs.front().scores.mean_iou, 1.0);
  options.interrupted = [] { return true; };
  const auto none = run(FakeSource(9), only({}), boxesAt0({0}), options);
  EXPECT_TRUE(none.interrupted);
  EXPECT_TRUE(std::isnan(none.runs.front().scores.mean_iou));
}

TEST(EvaluationRun, ATrackerThatFailsHasLostItsPoints) {
  GroundTruth truth;
  for (const int frame : {0, 1, 2, 3})
    truth.points[frame] = {{0, {{0, 5}, true}}, {1, {{10, 5}, true}}};
  const auto result = run(FakeSource(4), only({at(0.0), at(0.0), std::nullopt}), truth, {}, kEnds);
  const TrackerRun& failed = result.runs.front();
  EXPECT_DOUBLE_EQ(failed.scores.pck_10, 0.5);
  EXPECT_TRUE(failed.frames[2].was_asked);
  EXPECT_FALSE(failed.frames[3].was_asked);
  const double both = failed.frames[1].time_ms + failed.frames[2].time_ms;
  EXPECT_NEAR(failed.scores.fps, 2000.0 / both, 1e-6 * failed.scores.fps);
}

TEST(EvaluationRun, BoxesOfPointsAreOfThoseThatTheTruthSees) {
  GroundTruth truth;
  truth.points[0] = {{0, {{0, 5}, true}}, {1, {{10, 5}, true}}, {2, {{-1, -1}, false}}};
  TrackedFrame tracked = at(0.0);
  tracked.points.push_back({{90.0, 70.0}, 1.0, true});
  EXPECT_DOUBLE_EQ(scoreFrame(tracked, truth, 0).overlap, 1.0);
}

TEST(EvaluationRun, ATrackerThatFailsHasLostTheObjectForGood) {
  Trackers trackers = only({at(0.0), at(0.0), at(0.0), at(0.0)});
  trackers.push_back(std::make_unique<FakeTracker>(
      "other", std::vector<std::optional<TrackedFrame>>{at(0.0), {}, at(0.0), at(0.0)}));
  const auto result = run(FakeSource(4), trackers, boxesAt0({0, 1, 2, 3}));
  EXPECT_DOUBLE_EQ(result.runs[0].scores.mean_iou, 1.0);
  EXPECT_DOUBLE_EQ(result.runs[1].scores.mean_iou, 0.25);
  EXPECT_EQ(result.runs[1].scores.lost_frames, 3);
  ASSERT_EQ(result.faults.size(), 1U) << "told once";
  EXPECT_EQ(result.faults[0], "other failed on frame 1: cannot");
}

TEST(EvaluationRun, TheChainTrackerMustStart) {
  EXPECT_EQ(omissionsOf(refusalOf([] { run(FakeSource(2), only({std::nullopt}), boxesAt0({0})); }),
                        {"cannot"}),
            "");
}

TEST(EvaluationRun, EachTrackerIsStartedOnceAndSeesEveryFrame) {
  Trackers trackers = only({at(0.0), at(0.0), at(0.0)});
  std::vector<int> observed;
  std::vector<int> progress;
  EvaluationOptions options;
  options.observer = [&](const SourceFrame& frame, const TrackedFrame&) {
    observed.push_back(frame.index);
  };
  options.progress = [&](int done) { progress.push_back(done); };
  run(FakeSource(4, {2}), trackers, boxesAt0({0}), options);
  EXPECT_EQ(static_cast<const FakeTracker&>(*trackers.front()).starts(), 1);
  EXPECT_EQ(observed, (std::vector<int>{0, 1, 3}));
  EXPECT_EQ(progress, (std::vector<int>{1, 2, 3, 4}));
}

TEST(ScoreRecording, FramesWithoutAReportAreDropsAndDoNotCount) {
  FakeSource source(6, {4});
  const std::map<int, RecordedFrame> recording = {
      {0, {9.0, at(0.0)}}, {1, {2.0, at(5.0)}}, {3, {4.0, lost()}}};
  const auto result =
      scoreRecording(source, recording, boxesAt0({0, 1, 2, 3, 4, 5}), kStart, EvaluationOptions());
  EXPECT_EQ(result.dropped_frames, 2) << "frames 2 and 5";
  EXPECT_EQ(result.skipped_frames, 1) << "frame 4";
  const Scores& scores = result.runs.front().scores;
  EXPECT_EQ(scores.frames, 3);
  EXPECT_DOUBLE_EQ(scores.mean_iou, (1.0 + 1.0 / 3.0 + 0.0) / 3.0);
  EXPECT_EQ(scores.lost_frames, 1);
  EXPECT_DOUBLE_EQ(scores.latency_p50_ms, 3.0) << "of the updates, without the start";
  EXPECT_EQ(result.runs.front().frames[1].index, 1);
}

TEST(ScoreRecording, PointsOfAnotherNumberThanThePartsAreNotScored) {
  FakeSource source(2);
  const std::map<int, RecordedFrame> recording = {{0, {9.0, at(0.0)}}, {1, {2.0, at(0.0)}}};
  expectBoxesScoredOnly(
      scoreRecording(source, recording, threeParts(), kStart, EvaluationOptions()));
}

}  // namespace
}  // namespace chain_tracker
