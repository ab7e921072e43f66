// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/evaluation/evaluation_run.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <limits>
#include <optional>
#include <stdexcept>

#include "chain_tracker/image/pixel_geometry.h"

namespace chain_tracker {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kGrowth = 0.1;

/// Wall time of a call [ms].
template <typename Call>
double timed(const Call& call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  const std::chrono::duration<double, std::milli> elapsed =
      std::chrono::steady_clock::now() - start;
  return elapsed.count();
}

std::vector<cv::Point2d> visiblePoints(const std::map<int, TruePoint>& points) {
  std::vector<cv::Point2d> visible;
  for (const auto& entry : points) {
    if (entry.second.visible) visible.push_back(entry.second.position);
  }
  return visible;
}

/// The box that stands for the points seen; nullopt if they are too few to have one.
std::optional<cv::Rect2d> boxOf(const std::map<int, TruePoint>& points) {
  const std::vector<cv::Point2d> visible = visiblePoints(points);
  if (visible.size() < 2) return std::nullopt;
  return boxAround(visible);
}

/// The truth in boxes alone: those around its points where it has no others.
GroundTruth boxesOf(const GroundTruth& truth) {
  GroundTruth boxes = truth;
  boxes.points.clear();
  for (const auto& [frame, points] : truth.points) {
    if (const auto box = boxOf(points)) boxes.boxes.emplace(frame, box);
  }
  return boxes;
}

/// What can be scored of a tracker that carries so many points. A point is scored with the part of
/// its number, which is another place where the object was given by other points than the parts.
GroundTruth scorableTruth(const GroundTruth& truth, std::size_t carried, EvaluationResult& result) {
  const std::size_t parts = partCount(truth);
  if (parts == 0 || carried == 0 || carried == parts) return truth;
  result.faults.push_back("points are not scored, only boxes: the object is given by " +
                          std::to_string(carried) + " points, must be by the " +
                          std::to_string(parts) + " parts of the ground truth");
  return boxesOf(truth);
}

void scoreBox(const cv::Rect2d& box, const cv::Rect2d& truth, bool lost, FrameScore& score) {
  score.has_object = true;
  score.overlap = lost ? 0.0 : intersectionOverUnion(box, truth);
  score.center_error = lost ? kInfinity : centerDistance(box, truth);
}

void scorePoints(const TrackedFrame& tracked, const std::map<int, TruePoint>& truth,
                 FrameScore& score) {
  for (const auto& [index, point] : truth) {
    const auto k = static_cast<std::size_t>(index);
    if (k >= tracked.points.size()) continue;
    if (!point.visible) {
      ++score.hidden_points;
      continue;
    }
    score.point_errors.push_back(
        tracked.lost ? kInfinity : cv::norm(tracked.points[k].position - point.position));
  }
}

/// Of the points that the truth sees: its own box is that of these.
cv::Rect2d pointBox(const TrackedFrame& tracked, const std::map<int, TruePoint>& truth) {
  std::vector<cv::Point2d> points;
  for (const auto& [index, point] : truth) {
    const auto k = static_cast<std::size_t>(index);
    if (point.visible && k < tracked.points.size()) points.push_back(tracked.points[k].position);
  }
  return points.empty() ? tracked.box : boxAround(points);
}

std::string nameOf(const SourceFrame& frame) { return "frame " + std::to_string(frame.index); }

void skip(const std::string& fault, EvaluationResult& result) {
  ++result.skipped_frames;
  result.faults.push_back("skipped a frame: " + fault);
}

/// Hands the frames asked for, as far as they can be read, to `step` in order.
template <typename Step>
void forEachFrame(FrameSource& frames, const EvaluationOptions& options, EvaluationResult& result,
                  const Step& step) {
  SourceFrame frame;
  int read = 0;
  int seen = 0;
  while (options.max_frames == 0 || seen < options.max_frames) {
    result.interrupted = options.interrupted && options.interrupted();
    if (result.interrupted || !frames.next(frame)) break;
    ++read;
    if (frame.index < options.first_frame) continue;
    if (seen == 0 && !frame.fault.empty()) {
      throw std::invalid_argument(nameOf(frame) + ", in which the object is given: " + frame.fault);
    }
    ++seen;
    if (frame.fault.empty()) {
      step(frame);
    } else {
      skip(frame.fault, result);
    }
    if (options.progress) options.progress(seen);
  }
  if (seen > 0 || result.interrupted) return;
  throw std::invalid_argument("the object is given in frame " +
                              std::to_string(options.first_frame) + ", counted from 0, of only " +
                              std::to_string(read));
}

std::size_t pointsCarriedIn(const std::map<int, RecordedFrame>& recording) {
  std::size_t count = 0;
  for (const auto& entry : recording) count = std::max(count, entry.second.tracked.points.size());
  return count;
}

/// Of what a tracker that has failed says: it carries as many points as before, all of them lost.
TrackedFrame nothingKnown(const TrackerRun& run) {
  TrackedFrame frame;
  frame.state = "LOST";
  frame.lost = true;
  if (run.frames.empty()) return frame;
  frame.points = run.frames.front().tracked.points;
  for (CarriedPoint& point : frame.points) {
    point.confidence = 0.0;
    point.visible = false;
  }
  return frame;
}

/// Lets the tracker see the frame; of the chain tracker, a start must succeed. One that has failed
/// is not asked again: OpenCV's may crash then.
void process(EvaluatedTracker& tracker, const SourceFrame& frame, bool must_succeed,
             const GroundTruth& truth, TrackerRun& run) {
  EvaluatedFrame evaluated;
  evaluated.index = frame.index;
  const bool first = run.frames.empty();
  evaluated.tracked = nothingKnown(run);
  evaluated.was_asked = run.fault.empty();
  evaluated.time_ms = timed([&] {
    if (!evaluated.was_asked) return;
    try {
      evaluated.tracked = first ? tracker.start(frame.image) : tracker.update(frame.image);
    } catch (const std::exception& error) {
      if (must_succeed) throw;
      run.fault = run.name + " failed on " + nameOf(frame) + ": " + error.what();
    }
  });
  evaluated.score = scoreFrame(evaluated.tracked, truth, frame.index);
  run.frames.push_back(evaluated);
}

Scores scoresOf(const TrackerRun& run, double object_length) {
  std::vector<FrameScore> scores;
  std::vector<double> times;
  for (const EvaluatedFrame& frame : run.frames) {
    scores.push_back(frame.score);
    const bool is_start = frame.index == run.frames.front().index;
    if (frame.was_asked && !is_start) times.push_back(frame.time_ms);
  }
  return summarize(scores, object_length, times);
}

/// Scores the runs and tells of their faults.
void finish(double object_length, EvaluationResult& result) {
  for (TrackerRun& run : result.runs) {
    run.scores = scoresOf(run, object_length);
    if (!run.fault.empty()) result.faults.push_back(run.fault);
  }
}

}  // namespace

cv::Rect2d boxAround(const std::vector<cv::Point2d>& points) {
  const cv::Rect2d tight = uprightBounds(points);
  const double width = std::max(1.0, tight.width * (1.0 + kGrowth));
  const double height = std::max(1.0, tight.height * (1.0 + kGrowth));
  return {tight.x - 0.5 * (width - tight.width), tight.y - 0.5 * (height - tight.height), width,
          height};
}

cv::Rect2d comparableBox(const TrackedFrame& tracked, const GroundTruth& truth) {
  const bool turns = truth.boxes_turn && !tracked.outline.empty();
  return turns ? uprightBounds(tracked.outline) : tracked.box;
}

FrameScore scoreFrame(const TrackedFrame& tracked, const GroundTruth& truth, int frame) {
  FrameScore score;
  score.lost = tracked.lost;
  const auto points = truth.points.find(frame);
  if (points != truth.points.end()) scorePoints(tracked, points->second, score);
  const auto box = truth.boxes.find(frame);
  if (box != truth.boxes.end()) {
    if (box->second) scoreBox(comparableBox(tracked, truth), *box->second, tracked.lost, score);
  } else if (points != truth.points.end()) {
    if (const auto around = boxOf(points->second)) {
      scoreBox(pointBox(tracked, points->second), *around, tracked.lost, score);
    }
  }
  return score;
}

double objectLength(const std::vector<cv::Point2d>& start, bool rectangle) {
  if (rectangle && start.size() == 4) return cv::norm(start[2] - start[0]);
  return lengthOf(start);
}

EvaluationResult evaluate(FrameSource& frames,
                          const std::vector<std::unique_ptr<EvaluatedTracker>>& trackers,
                          const GroundTruth& truth, const std::vector<cv::Point2d>& start,
                          const EvaluationOptions& options) {
  EvaluationResult result;
  for (const auto& tracker : trackers) result.runs.push_back({tracker->name(), {}, {}, ""});
  const GroundTruth scorable = scorableTruth(truth, start.size(), result);
  cv::Size size;
  forEachFrame(frames, options, result, [&](const SourceFrame& frame) {
    if (size.empty()) size = frame.image.size();
    if (frame.image.size() != size) {
      skip(nameOf(frame) + " has another size than the first one", result);
      return;
    }
    for (std::size_t i = 0; i < trackers.size(); ++i) {
      TrackerRun& run = result.runs[i];
      process(*trackers[i], frame, i == 0 && run.frames.empty(), scorable, run);
    }
    if (options.observer) options.observer(frame, result.runs.front().frames.back().tracked);
  });
  finish(objectLength(start, truth.points.empty()), result);
  return result;
}

EvaluationResult scoreRecording(FrameSource& frames, const std::map<int, RecordedFrame>& recording,
                                const GroundTruth& truth, const std::vector<cv::Point2d>& start,
                                const EvaluationOptions& options) {
  EvaluationResult result;
  result.runs.push_back({"chain_tracker", {}, {}, ""});
  const GroundTruth scorable = scorableTruth(truth, pointsCarriedIn(recording), result);
  forEachFrame(frames, options, result, [&](const SourceFrame& frame) {
    const auto recorded = recording.find(frame.index);
    if (recorded == recording.end()) {
      ++result.dropped_frames;
      return;
    }
    const auto& [time_ms, tracked] = recorded->second;
    result.runs.front().frames.push_back(
        {frame.index, time_ms, true, tracked, scoreFrame(tracked, scorable, frame.index)});
    if (options.observer) options.observer(frame, tracked);
  });
  finish(objectLength(start, truth.points.empty()), result);
  return result;
}

}  // namespace chain_tracker
