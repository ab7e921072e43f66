// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/evaluation/evaluation_run.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

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

void scoreBox(const cv::Rect2d& box, const cv::Rect2d& truth, bool lost, FrameScore& score) {
  score.has_object = true;
  score.overlap = lost ? 0.0 : intersectionOverUnion(box, truth);
  score.center_error = lost ? kInfinity : centerDistance(box, truth);
}

void scorePoints(const TrackedFrame& tracked, const std::map<int, TruePoint>& truth,
                 FrameScore& score) {
  for (const auto& [index, point] : truth) {
    const auto k = static_cast<std::size_t>(index);
    if (!point.visible || k >= tracked.points.size()) continue;
    score.point_errors.push_back(
        tracked.lost ? kInfinity : cv::norm(tracked.points[k].position - point.position));
  }
}

cv::Rect2d pointBox(const TrackedFrame& tracked) {
  if (tracked.points.empty()) return tracked.box;
  std::vector<cv::Point2d> points;
  for (const CarriedPoint& point : tracked.points) points.push_back(point.position);
  return boxAround(points);
}

EvaluatedFrame process(EvaluatedTracker& tracker, const SourceFrame& frame, bool first,
                       const GroundTruth& truth) {
  EvaluatedFrame evaluated;
  evaluated.index = frame.index;
  evaluated.time_ms = timed([&] {
    evaluated.tracked = first ? tracker.start(frame.image) : tracker.update(frame.image);
  });
  evaluated.score = scoreFrame(evaluated.tracked, truth, frame.index);
  return evaluated;
}

Scores scoresOf(const TrackerRun& run, double object_length) {
  std::vector<FrameScore> scores;
  std::vector<double> times;
  for (const EvaluatedFrame& frame : run.frames) {
    scores.push_back(frame.score);
    if (frame.index != run.frames.front().index) times.push_back(frame.time_ms);
  }
  return summarize(scores, object_length, times);
}

}  // namespace

cv::Rect2d boxAround(const std::vector<cv::Point2d>& points) {
  const cv::Rect2d tight = uprightBounds(points);
  const double width = std::max(1.0, tight.width * (1.0 + kGrowth));
  const double height = std::max(1.0, tight.height * (1.0 + kGrowth));
  return {tight.x - 0.5 * (width - tight.width), tight.y - 0.5 * (height - tight.height), width,
          height};
}

FrameScore scoreFrame(const TrackedFrame& tracked, const GroundTruth& truth, int frame) {
  FrameScore score;
  score.lost = tracked.lost;
  const auto points = truth.points.find(frame);
  if (points != truth.points.end()) scorePoints(tracked, points->second, score);
  const auto box = truth.boxes.find(frame);
  if (box != truth.boxes.end()) {
    if (box->second) scoreBox(tracked.box, *box->second, tracked.lost, score);
    score.has_absence = !box->second;
  } else if (points != truth.points.end()) {
    const std::vector<cv::Point2d> visible = visiblePoints(points->second);
    if (visible.size() >= 2) {
      scoreBox(pointBox(tracked), boxAround(visible), tracked.lost, score);
    }
  }
  return score;
}

double objectLength(const std::vector<cv::Point2d>& start, bool rectangle) {
  if (rectangle && start.size() == 4) return cv::norm(start[2] - start[0]);
  double length = 0.0;
  for (std::size_t i = 1; i < start.size(); ++i) length += cv::norm(start[i] - start[i - 1]);
  return length;
}

EvaluationResult evaluate(FrameSource& frames,
                          const std::vector<std::unique_ptr<EvaluatedTracker>>& trackers,
                          const GroundTruth& truth, const std::vector<cv::Point2d>& start,
                          const EvaluationOptions& options) {
  EvaluationResult result;
  for (const auto& tracker : trackers) result.runs.push_back({tracker->name(), {}, {}});
  SourceFrame frame;
  int processed = 0;
  bool first = true;
  while ((options.max_frames == 0 || processed < options.max_frames) && frames.next(frame)) {
    if (options.interrupted && options.interrupted()) {
      result.interrupted = true;
      break;
    }
    if (frame.index < options.first_frame) continue;
    ++processed;
    if (!frame.fault.empty()) {
      ++result.skipped_frames;
      result.faults.push_back(frame.fault);
      continue;
    }
    for (std::size_t i = 0; i < trackers.size(); ++i) {
      result.runs[i].frames.push_back(process(*trackers[i], frame, first, truth));
    }
    first = false;
    if (options.observer) options.observer(frame, result.runs.front().frames.back().tracked);
    if (options.progress) options.progress(processed);
  }
  const double length = objectLength(start, truth.points.empty());
  for (TrackerRun& run : result.runs) {
    if (!run.frames.empty()) run.scores = scoresOf(run, length);
  }
  return result;
}

}  // namespace chain_tracker
