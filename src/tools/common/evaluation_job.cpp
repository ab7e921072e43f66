// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_job.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "bag_frames.h"
#include "chain_tracker/chain/auto_model.h"
#include "chain_tracker/evaluation/evaluation_run.h"
#include "chain_tracker/ros/model_folder.h"
#include "evaluation_files.h"
#include "evaluation_pictures.h"
#include "progress.h"

namespace chain_tracker {
namespace {

namespace fs = std::filesystem;

void warn(const std::string& message) { std::cerr << "evaluate: " << message << "\n"; }

struct Input {
  std::string name;
  std::unique_ptr<FrameSource> frames;
  GroundTruth truth;
  std::optional<SequenceStart> start;
};

void readTruthFile(const std::string& path, GroundTruth& truth) {
  if (fs::path(path).extension() == ".csv") {
    readPoints(path, truth);
  } else {
    readBoxes(path, truth);
  }
}

std::unique_ptr<FrameSource> openSource(const EvaluationJob& job) {
  return job.bag.empty() ? openFrames(job.sequence) : openBagFrames(job.bag, job.topic);
}

Input openBag(const EvaluationJob& job) {
  Input input{fs::path(job.bag).stem().string(), openSource(job), {}, {}};
  for (const std::string& finding : checkBag(job.bag, job.topic)) warn(job.bag + ": " + finding);
  if (!job.ground_truth.empty() && job.ground_truth.front() == '/' &&
      !fs::exists(job.ground_truth)) {
    input.truth = readTruthTopic(job.bag, job.ground_truth, job.topic);
  } else if (!job.ground_truth.empty()) {
    readTruthFile(job.ground_truth, input.truth);
  }
  input.start = readStart("", input.truth);
  return input;
}

Input openSequence(const EvaluationJob& job) {
  const fs::path path = fs::path(job.sequence).lexically_normal();
  const fs::path folder = fs::is_directory(path) ? path : fs::path();
  const fs::path name = path.has_filename() ? path.stem() : path.parent_path().filename();
  Input input{name.string(), openSource(job), {}, {}};
  if (!job.ground_truth.empty()) {
    readTruthFile(job.ground_truth, input.truth);
  } else if (!folder.empty()) {
    input.truth = readGroundTruth(folder.string());
  }
  input.start = readStart(folder.string(), input.truth);
  return input;
}

SequenceStart startOf(const EvaluationJob& job, const Input& input) {
  SequenceStart start = input.start.value_or(SequenceStart());
  if (!job.points.empty()) start.points = job.points;
  if (!job.model.empty()) start.model = job.model;
  if (start.points.empty()) {
    throw std::invalid_argument(
        input.name +
        " has neither ground truth nor an init.yaml that say where the object is: "
        "give --points x,y,x,y,... or --ground-truth");
  }
  if (start.model == "auto") start.model = autoModelName(start.points);
  return start;
}

cv::Rect2d firstBox(const GroundTruth& truth, const SequenceStart& start) {
  const auto box = truth.boxes.find(start.first_frame);
  if (box != truth.boxes.end() && box->second) return *box->second;
  return boxAround(start.points);
}

std::vector<std::unique_ptr<EvaluatedTracker>> makeTrackers(const EvaluationJob& job,
                                                            const GroundTruth& truth,
                                                            const SequenceStart& start) {
  const ModelFolder models(ModelFolder::ofThisPackage());
  std::vector<std::unique_ptr<EvaluatedTracker>> trackers;
  trackers.push_back(makeChainTracker(models.load(start.model), start.points));
  for (const std::string& name : job.baselines) {
    trackers.push_back(makeBaseline(name, firstBox(truth, start)));
  }
  return trackers;
}

void warnOfGaps(const Input& input, const EvaluationResult& result, const EvaluationJob& job) {
  for (const std::string& fault : result.faults) warn("skipped a frame: " + fault);
  if (input.truth.empty()) {
    warn(input.name + " has no ground truth: there are tracks, but no scores");
    return;
  }
  if (result.interrupted || job.max_frames > 0 || result.runs.front().frames.empty()) return;
  int last_truth = -1;
  if (!input.truth.boxes.empty()) last_truth = input.truth.boxes.rbegin()->first;
  if (!input.truth.points.empty()) {
    last_truth = std::max(last_truth, input.truth.points.rbegin()->first);
  }
  const int last_frame = result.runs.front().frames.back().index;
  if (last_truth == last_frame) return;
  warn(input.name + ": the ground truth ends at frame " + std::to_string(last_truth) +
       ", the frames at " + std::to_string(last_frame) + "; only frames with both count");
}

}  // namespace

nlohmann::json runJob(const EvaluationJob& job, const std::function<bool()>& interrupted) {
  Input input = job.bag.empty() ? openSequence(job) : openBag(job);
  const SequenceStart start = startOf(job, input);
  const auto trackers = makeTrackers(job, input.truth, start);
  fs::create_directories(job.out);

  const int left = std::max(0, input.frames->count() - start.first_frame);
  Progress progress(job.max_frames > 0 ? std::min(job.max_frames, left) : left);
  OverlayVideo video(job.video ? job.out + "/overlay.mp4" : "");
  EvaluationOptions options;
  options.first_frame = start.first_frame;
  options.max_frames = job.max_frames;
  options.interrupted = interrupted;
  options.progress = [&](int done) { progress.report(done); };
  options.observer = [&](const SourceFrame& frame, const TrackedFrame& tracked) {
    video.add(frame, tracked, input.truth);
  };
  const EvaluationResult result =
      evaluate(*input.frames, trackers, input.truth, start.points, options);
  progress.finish();
  warnOfGaps(input, result, job);
  if (result.runs.front().frames.empty()) {
    throw std::invalid_argument(input.name + " has no frame that can be read");
  }
  const nlohmann::json summary = summaryOf(result, input.name, start.model);
  writeResults(result, summary, job.out);
  writeWorstFrames(*openSource(job), result, input.truth, job.out + "/worst_frames.jpg");
  return summary;
}

}  // namespace chain_tracker
