// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_files.h"

#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

#include "result_files.h"
#include "text_files.h"

namespace chain_tracker {
namespace {

using nlohmann::json;

json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

/// Of a lost object nothing is known but that it is lost.
double known(const TrackedFrame& tracked, double value) {
  return tracked.lost ? std::numeric_limits<double>::quiet_NaN() : value;
}

ObjectRow objectRow(const EvaluatedFrame& frame) {
  const TrackedFrame& tracked = frame.tracked;
  ObjectRow row;
  row.frame = frame.index;
  row.time_ms = frame.time_ms;
  row.state = tracked.state;
  row.confidence = tracked.confidence;
  row.x = known(tracked, tracked.box.x);
  row.y = known(tracked, tracked.box.y);
  row.w = known(tracked, tracked.box.width);
  row.h = known(tracked, tracked.box.height);
  row.theta = known(tracked, tracked.theta);
  row.scale = known(tracked, tracked.scale);
  return row;
}

PartRow partRow(const EvaluatedFrame& frame, int index) {
  const TrackedFrame& tracked = frame.tracked;
  const PartState& part = tracked.parts[static_cast<std::size_t>(index)];
  PartRow row;
  row.frame = frame.index;
  row.part = index;
  row.x = known(tracked, part.position.x);
  row.y = known(tracked, part.position.y);
  row.theta = known(tracked, part.orientation);
  row.size = known(tracked, part.side);
  row.confidence = part.confidence;
  row.visible = part.visible;
  return row;
}

PointRow pointRow(const EvaluatedFrame& frame, int index) {
  const TrackedFrame& tracked = frame.tracked;
  const CarriedPoint& point = tracked.points[static_cast<std::size_t>(index)];
  PointRow row;
  row.frame = frame.index;
  row.point = index;
  row.x = known(tracked, point.position.x);
  row.y = known(tracked, point.position.y);
  row.confidence = point.confidence;
  row.visible = point.visible;
  return row;
}

void writeObjects(const TrackerRun& run, const std::string& folder) {
  std::ostringstream objects;
  std::ostringstream parts;
  std::ostringstream points;
  objects << kObjectHeader << "\n";
  parts << kPartHeader << "\n";
  points << kPointHeader << "\n";
  for (const EvaluatedFrame& frame : run.frames) {
    const TrackedFrame& tracked = frame.tracked;
    objects << toCsv(objectRow(frame)) << "\n";
    for (int k = 0; k < static_cast<int>(tracked.parts.size()); ++k) {
      parts << toCsv(partRow(frame, k)) << "\n";
    }
    for (int k = 0; k < static_cast<int>(tracked.points.size()); ++k) {
      points << toCsv(pointRow(frame, k)) << "\n";
    }
  }
  writeText(folder + "/objects.csv", objects.str());
  writeText(folder + "/parts.csv", parts.str());
  writeText(folder + "/points.csv", points.str());
}

/// Empty where a frame has no truth or the tracker no answer.
std::string cell(bool known, double value) {
  if (!known || !std::isfinite(value)) return "";
  std::ostringstream text;
  text << std::fixed << std::setprecision(4) << value;
  return text.str();
}

void writeScores(const EvaluationResult& result, const std::string& folder) {
  std::ostringstream table;
  table << "tracker,frame,lost,iou,center_error_px,part_error_px\n";
  for (const TrackerRun& run : result.runs) {
    for (const EvaluatedFrame& frame : run.frames) {
      const FrameScore& score = frame.score;
      table << run.name << "," << frame.index << "," << (score.lost ? 1 : 0) << ","
            << cell(score.has_object, score.overlap) << ","
            << cell(score.has_object, score.center_error) << ","
            << cell(!score.point_errors.empty(), mean(score.point_errors)) << "\n";
    }
  }
  writeText(folder + "/scores.csv", table.str());
}

void appendLine(const std::string& name, const json& scores, std::ostringstream& table) {
  table << std::left << std::setw(15) << name << std::right << std::setw(8)
        << figure(scores["mean_iou"], 3) << std::setw(8) << figure(scores["success_auc"], 3)
        << std::setw(8) << figure(scores["pascal_50"], 3) << std::setw(8)
        << figure(scores["precision_20px"], 3) << std::setw(9)
        << figure(scores["mean_center_error_px"], 1) << std::setw(9)
        << figure(scores["part_error_px"]["mean"], 1) << std::setw(8) << figure(scores["pck_10"], 3)
        << std::setw(7) << scores["lost_frames"].get<int>() << std::setw(8)
        << figure(scores["fps"], 0) << "\n";
}

}  // namespace

std::string figure(const json& value, int decimals) {
  if (value.is_null()) return "-";
  std::ostringstream stream;
  stream << std::fixed << std::setprecision(decimals) << value.get<double>();
  return stream.str();
}

json toJson(const Scores& scores) {
  return {{"frames", scores.frames},
          {"scored_frames", scores.scored_frames},
          {"mean_iou", number(scores.mean_iou)},
          {"success_auc", number(scores.success_auc)},
          {"pascal_50", number(scores.pascal_50)},
          {"precision_20px", number(scores.precision_20px)},
          {"mean_center_error_px", number(scores.mean_center_error_px)},
          {"part_error_px",
           {{"mean", number(scores.part_error_mean_px)},
            {"median", number(scores.part_error_median_px)},
            {"p95", number(scores.part_error_p95_px)}}},
          {"pck_10", number(scores.pck_10)},
          {"lost_frames", scores.lost_frames},
          {"reacquired", scores.reacquired},
          {"occlusions", scores.occlusions},
          {"occlusions_recovered", scores.occlusions_recovered},
          {"fps", number(scores.fps)},
          {"latency_ms",
           {{"p50", number(scores.latency_p50_ms)}, {"p99", number(scores.latency_p99_ms)}}}};
}

json summaryOf(const EvaluationResult& result, const std::string& sequence,
               const std::string& model) {
  json summary = toJson(result.runs.front().scores);
  summary["sequence"] = sequence;
  summary["model"] = model;
  summary["skipped_frames"] = result.skipped_frames;
  summary["dropped_frames"] = result.dropped_frames;
  summary["faults"] = result.faults;
  summary["interrupted"] = result.interrupted;
  summary["baselines"] = json::object();
  for (std::size_t i = 1; i < result.runs.size(); ++i) {
    summary["baselines"][result.runs[i].name] = toJson(result.runs[i].scores);
  }
  return summary;
}

void writeResults(const EvaluationResult& result, const json& summary, const std::string& folder) {
  writeObjects(result.runs.front(), folder);
  writeScores(result, folder);
  writeJson(folder + "/summary.json", summary);
}

std::string tableOf(const json& summary) {
  std::ostringstream table;
  table << std::left << std::setw(15) << "tracker" << std::right << std::setw(8) << "IoU"
        << std::setw(8) << "AUC" << std::setw(8) << "IoU>.5" << std::setw(8) << "20 px"
        << std::setw(9) << "centre" << std::setw(9) << "points" << std::setw(8) << "PCK10"
        << std::setw(7) << "lost" << std::setw(8) << "fps"
        << "\n";
  appendLine("chain_tracker", summary, table);
  for (const auto& [name, scores] : summary["baselines"].items()) appendLine(name, scores, table);
  return table.str();
}

}  // namespace chain_tracker
