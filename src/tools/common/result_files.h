// SPDX-License-Identifier: BSD-3-Clause
/// Lines of the result files objects.csv, parts.csv and points.csv, and the summary of a run.
/// No files are opened here and ROS is not known.
#pragma once

#include <array>
#include <cstdio>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "chain_tracker/evaluation/metrics.h"

namespace chain_tracker {

/// Positions and lengths [px], angles [rad], confidences [0, 1]; NaN where there is no value.
struct ObjectRow {
  int frame = 0;
  double time_ms = 0.0;  ///< wall time of processing the frame
  std::string state;     ///< "INITIALIZING", "TRACKING", "OCCLUDED" or "LOST"
  double confidence = 0.0;
  double x = 0.0, y = 0.0, w = 0.0, h = 0.0;  ///< box, by its top-left corner
  double theta = 0.0;
  double scale = 1.0;
};

struct PartRow {
  int frame = 0;
  int part = 0;  ///< counts from 0 along the chain
  double x = 0.0, y = 0.0;
  double theta = 0.0;
  double size = 0.0;
  double confidence = 0.0;
  bool visible = false;
};

struct PointRow {
  int frame = 0;
  int point = 0;  ///< counts from 0 in the order given at initialisation
  double x = 0.0, y = 0.0;
  double confidence = 0.0;
  bool visible = false;
};

constexpr const char* kObjectHeader = "frame,time_ms,state,confidence,x,y,w,h,theta,scale";
constexpr const char* kPartHeader = "frame,part,x,y,theta,size,confidence,visible";
constexpr const char* kPointHeader = "frame,point,x,y,confidence,visible";

namespace detail {

/// printf into a string; long enough for any row of doubles below 1e20.
template <typename... Values>
std::string format(const char* pattern, Values... values) {
  std::array<char, 512> line{};
  std::snprintf(line.data(), line.size(), pattern, values...);
  return line.data();
}

}  // namespace detail

inline std::string toCsv(const ObjectRow& row) {
  return detail::format("%d,%.3f,%s,%.4f,%.2f,%.2f,%.2f,%.2f,%.5f,%.5f", row.frame, row.time_ms,
                        row.state.c_str(), row.confidence, row.x, row.y, row.w, row.h, row.theta,
                        row.scale);
}

inline std::string toCsv(const PartRow& row) {
  return detail::format("%d,%d,%.2f,%.2f,%.5f,%.2f,%.4f,%d", row.frame, row.part, row.x, row.y,
                        row.theta, row.size, row.confidence, row.visible ? 1 : 0);
}

inline std::string toCsv(const PointRow& row) {
  return detail::format("%d,%d,%.2f,%.2f,%.4f,%d", row.frame, row.point, row.x, row.y,
                        row.confidence, row.visible ? 1 : 0);
}

/// Collects the rows of one object and sums them up.
class RunSummary {
 public:
  void add(const ObjectRow& row) {
    times_ms_.push_back(row.time_ms);
    total_ms_ += row.time_ms;
    ++states_[row.state];
    if (row.state != "LOST") confidence_sum_ += row.confidence;
  }

  int frames() const { return static_cast<int>(times_ms_.size()); }

  /// tracked_share: share of the frames in which the object is not LOST. mean_confidence is that of
  /// these frames. fps: frames a second of processing time alone. null where there is no value.
  nlohmann::json toJson() const {
    const auto lost_it = states_.find("LOST");
    const int lost = lost_it == states_.end() ? 0 : lost_it->second;
    const int tracked = frames() - lost;
    nlohmann::json summary;
    summary["frames"] = frames();
    summary["fps"] = ratio(1000.0 * frames(), total_ms_);
    summary["latency_ms"] = {{"p50", percentile(times_ms_, 0.50)},
                             {"p99", percentile(times_ms_, 0.99)}};
    summary["tracked_share"] = ratio(tracked, frames());
    summary["mean_confidence"] = ratio(confidence_sum_, tracked);
    summary["lost_frames"] = lost;
    summary["states"] = states_;
    return summary;
  }

 private:
  static double ratio(double numerator, double denominator) {
    return denominator > 0.0 ? numerator / denominator : std::numeric_limits<double>::quiet_NaN();
  }

  std::vector<double> times_ms_;
  double total_ms_ = 0.0;
  double confidence_sum_ = 0.0;
  std::map<std::string, int> states_;
};

}  // namespace chain_tracker
