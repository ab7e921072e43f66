// SPDX-License-Identifier: BSD-3-Clause
/// One sequence or bag, evaluated and written down.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

namespace chain_tracker {

struct EvaluationJob {
  std::string sequence;  ///< folder or video; empty: a bag
  std::string bag;
  std::string topic;      ///< of the images in the bag
  std::string recording;  ///< bag of a live tracker's objects, scored instead of a run
  std::string recorded_topic = "/chain_tracker/objects";  ///< of the objects in that bag
  std::string id;                   ///< of the recorded object; empty: the first one
  std::string ground_truth;         ///< file, or topic of the bag; empty: the folder's
  std::string model;                ///< name, file, "auto" or empty: what the sequence says
  std::vector<cv::Point2d> points;  ///< in frame 0; empty: what the sequence says
  std::vector<std::string> baselines;
  int max_frames = 0;
  int threads = 1;    ///< of an update, in [1, 256]
  bool grey = false;  ///< whether to turn images grey first
  bool video = false;
  bool report = true;  ///< whether to draw report.html
  std::string out;
};

/// Throws std::invalid_argument naming what is wrong with the job's ground truth file or topic.
void checkGroundTruth(const EvaluationJob& job);

/// Runs the job, writes its folder and prints its table; returns the summary written. What a user
/// should know before trusting the input goes to standard error.
/// Throws std::invalid_argument or std::runtime_error naming what is wrong.
nlohmann::json runJob(const EvaluationJob& job, const std::function<bool()>& interrupted);

}  // namespace chain_tracker
