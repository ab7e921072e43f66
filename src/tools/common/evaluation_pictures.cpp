// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_pictures.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace chain_tracker {
namespace {

const cv::Scalar kTrackedColor(80, 220, 60);
const cv::Scalar kHiddenColor(150, 150, 150);
const cv::Scalar kTruthColor(255, 120, 30);
const cv::Scalar kLostColor(40, 40, 230);
constexpr double kVideoRate = 30.0;
constexpr std::size_t kWorstFrames = 8;
constexpr int kStripColumns = 4;
constexpr int kCellWidth = 400;
constexpr int kCellGap = 4;
/// Frames of the filmstrip are at least this share of the sequence apart, or they look the same.
constexpr double kApart = 0.02;

void drawTruth(const GroundTruth& truth, int frame, int thickness, cv::Mat& canvas) {
  const auto box = truth.boxes.find(frame);
  if (box != truth.boxes.end() && box->second) {
    cv::rectangle(canvas, cv::Rect(*box->second), kTruthColor, thickness, cv::LINE_AA);
  }
  const auto points = truth.points.find(frame);
  if (points == truth.points.end()) return;
  for (const auto& point : points->second) {
    cv::drawMarker(canvas, cv::Point(point.second.position), kTruthColor, cv::MARKER_CROSS,
                   6 * thickness, thickness, cv::LINE_AA);
  }
}

void drawTracked(const TrackedFrame& tracked, const GroundTruth& truth, int thickness,
                 cv::Mat& canvas) {
  for (std::size_t k = 0; k < tracked.parts.size(); ++k) {
    const PartState& part = tracked.parts[k];
    const cv::Scalar color = part.visible ? kTrackedColor : kHiddenColor;
    if (k > 0) {
      cv::line(canvas, cv::Point(tracked.parts[k - 1].position), cv::Point(part.position), color,
               thickness, cv::LINE_AA);
    }
    cv::circle(canvas, cv::Point(part.position), 2 * thickness, color, cv::FILLED, cv::LINE_AA);
  }
  cv::rectangle(canvas, cv::Rect(comparableBox(tracked, truth)), kTrackedColor, thickness,
                cv::LINE_AA);
}

double badness(const FrameScore& score) {
  if (score.has_object) return 1.0 - score.overlap;
  return score.point_errors.empty() ? -1.0 : mean(score.point_errors);
}

/// The worst frames by their index, each some way from the others.
std::map<int, const EvaluatedFrame*> worstOf(const TrackerRun& run) {
  std::vector<const EvaluatedFrame*> ranked;
  for (const EvaluatedFrame& frame : run.frames) {
    if (badness(frame.score) > 0.0) ranked.push_back(&frame);
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto* a, const auto* b) {
    return badness(a->score) > badness(b->score);
  });
  const int apart = static_cast<int>(kApart * static_cast<double>(run.frames.size()));
  std::map<int, const EvaluatedFrame*> worst;
  for (const EvaluatedFrame* frame : ranked) {
    const auto next = worst.lower_bound(frame->index - apart);
    if (next != worst.end() && next->first <= frame->index + apart) continue;
    worst[frame->index] = frame;
    if (worst.size() == kWorstFrames) break;
  }
  return worst;
}

/// The pictures, all of one size, in rows.
cv::Mat stripOf(const std::vector<cv::Mat>& cells) {
  const cv::Size cell(kCellWidth, kCellWidth * cells.front().rows / cells.front().cols);
  const int columns = std::min(kStripColumns, static_cast<int>(cells.size()));
  const int rows = (static_cast<int>(cells.size()) + columns - 1) / columns;
  cv::Mat strip(rows * (cell.height + kCellGap) - kCellGap,
                columns * (cell.width + kCellGap) - kCellGap, CV_8UC3, cv::Scalar::all(255));
  for (int i = 0; i < static_cast<int>(cells.size()); ++i) {
    const cv::Point corner((i % columns) * (cell.width + kCellGap),
                           (i / columns) * (cell.height + kCellGap));
    cv::resize(cells[static_cast<std::size_t>(i)], strip(cv::Rect(corner, cell)), cell, 0.0, 0.0,
               cv::INTER_AREA);
  }
  return strip;
}

}  // namespace

cv::Mat drawComparison(const SourceFrame& frame, const TrackedFrame& tracked,
                       const GroundTruth& truth) {
  cv::Mat canvas;
  if (frame.image.channels() == 3) {
    canvas = frame.image.clone();
  } else {
    cv::cvtColor(frame.image, canvas, cv::COLOR_GRAY2BGR);
  }
  const int thickness = std::max(1, cvRound(canvas.cols / 320.0));
  drawTruth(truth, frame.index, thickness, canvas);
  if (!tracked.lost) drawTracked(tracked, truth, thickness, canvas);
  const std::string label = std::to_string(frame.index) + " " + tracked.state + " " +
                            std::to_string(cvRound(100.0 * tracked.confidence)) + " %";
  cv::putText(canvas, label, {8, 14 + 12 * thickness}, cv::FONT_HERSHEY_SIMPLEX,
              0.4 * thickness + 0.2, tracked.lost ? kLostColor : kTrackedColor, thickness + 1,
              cv::LINE_AA);
  return canvas;
}

OverlayVideo::OverlayVideo(std::string path) : path_(std::move(path)) {}

void OverlayVideo::add(const SourceFrame& frame, const TrackedFrame& tracked,
                       const GroundTruth& truth) {
  if (path_.empty()) return;
  const cv::Mat picture = drawComparison(frame, tracked, truth);
  if (!writer_.isOpened()) {
    writer_.open(path_, cv::VideoWriter::fourcc('a', 'v', 'c', '1'), kVideoRate, picture.size());
  }
  if (!writer_.isOpened()) {
    writer_.open(path_, cv::VideoWriter::fourcc('m', 'p', '4', 'v'), kVideoRate, picture.size());
  }
  if (!writer_.isOpened()) throw std::runtime_error(path_ + " cannot be written");
  writer_.write(picture);
}

void writeWorstFrames(FrameSource& frames, const EvaluationResult& result, const GroundTruth& truth,
                      const std::string& path) {
  const std::map<int, const EvaluatedFrame*> worst = worstOf(result.runs.front());
  std::vector<cv::Mat> cells;
  SourceFrame frame;
  while (cells.size() < worst.size() && frames.next(frame)) {
    const auto entry = worst.find(frame.index);
    if (entry == worst.end() || frame.image.empty()) continue;
    cells.push_back(drawComparison(frame, entry->second->tracked, truth));
  }
  if (cells.empty()) return;
  if (!cv::imwrite(path, stripOf(cells))) throw std::runtime_error(path + " cannot be written");
}

}  // namespace chain_tracker
