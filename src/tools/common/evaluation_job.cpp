// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_job.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "bag_frames.h"
#include "chain_tracker/chain/auto_model.h"
#include "chain_tracker/evaluation/evaluation_run.h"
#include "chain_tracker/ros/model_folder.h"
#include "child_process.h"
#include "evaluation_files.h"
#include "evaluation_pictures.h"
#include "progress.h"
#include "recorded_objects.h"

namespace chain_tracker {
namespace {

namespace fs = std::filesystem;

void warn(const std::string& message) { std::cerr << "evaluate: " << message << "\n"; }

struct Input {
  std::string name;
  std::unique_ptr<FrameSource> frames;
  GroundTruth truth;
  std::optional<SequenceStart> start;
  std::optional<ObjectRecording> recording;
};

void readTruthFile(const std::string& path, GroundTruth& truth) {
  if (fs::path(path).extension() == ".csv") {
    readPoints(path, truth);
  } else {
    readBoxes(path, truth);
  }
}

std::unique_ptr<FrameSource> openSource(const EvaluationJob& job) {
  auto frames = job.bag.empty() ? openFrames(job.sequence) : openBagFrames(job.bag, job.topic);
  return job.grey ? greyFrames(std::move(frames)) : std::move(frames);
}

/// Topics begin with a slash; so may files, which are there or have an ending.
bool isTopic(const std::string& ground_truth) {
  return !ground_truth.empty() && ground_truth.front() == '/' && !fs::exists(ground_truth) &&
         !fs::path(ground_truth).has_extension();
}

/// The object that is scored, as the truth has it. It may have another name there.
ObjectRecording readTruthTopic(const EvaluationJob& job, const std::string& scored) {
  const std::map<ros::Time, int> index_of = indexByStamp(job.bag, job.topic);
  ObjectRecording first = readRecording(job.bag, job.ground_truth, index_of, "");
  if (first.ids.count(scored) > 0) {
    return readRecording(job.bag, job.ground_truth, index_of, scored);
  }
  if (first.ids.size() > 1) {
    warn(job.bag + ": " + job.ground_truth + " has " + namesOf(first.ids) + "; '" + first.id +
         "' is taken for the truth");
  }
  return first;
}

void takeTruthTopic(const EvaluationJob& job, Input& input) {
  const ObjectRecording recorded = readTruthTopic(job, input.recording ? input.recording->id : "");
  input.truth = truthFrom(recorded);
  input.start = readStart("", input.truth);
  if (input.start) input.start->model = recorded.model;
}

/// The shape that a recorded tracker was started with, as it published it.
SequenceStart startOf(const ObjectRecording& recording) {
  const auto& [frame, recorded] = *recording.frames.begin();
  SequenceStart start{recording.model, {}, frame};
  for (const CarriedPoint& point : recorded.tracked.points) start.points.push_back(point.position);
  return start;
}

void takeRecording(const EvaluationJob& job, Input& input) {
  input.recording =
      readRecording(job.recording, job.recorded_topic, indexByStamp(job.bag, job.topic), job.id);
  const ObjectRecording& recording = *input.recording;
  if (recording.frames.empty()) {
    throw std::invalid_argument(job.recording + ": no message on " + job.recorded_topic +
                                " tells of an object in an image of " + job.topic + " of " +
                                job.bag);
  }
  const auto tell = [&](int count, const std::string& what) {
    if (count > 0) warn(job.recording + ": " + std::to_string(count) + " messages " + what);
  };
  tell(recording.without_image, "have the stamp of no image and are left out");
  tell(recording.damaged, "cannot be read and are left out");
  if (job.id.empty() && recording.ids.size() > 1) {
    warn(job.recording + ": the recording has " + namesOf(recording.ids) + "; '" + recording.id +
         "' is scored");
  }
}

Input openBag(const EvaluationJob& job) {
  Input input{fs::path(job.bag).stem().string(), openSource(job), {}, {}, {}};
  for (const std::string& finding : checkBag(job.bag, job.topic)) warn(job.bag + ": " + finding);
  if (!job.recording.empty()) takeRecording(job, input);
  if (isTopic(job.ground_truth)) {
    takeTruthTopic(job, input);
  } else if (!job.ground_truth.empty()) {
    readTruthFile(job.ground_truth, input.truth);
    input.start = readStart("", input.truth);
  }
  if (input.recording && !input.start) input.start = startOf(*input.recording);
  return input;
}

Input openSequence(const EvaluationJob& job) {
  const fs::path path = fs::path(job.sequence).lexically_normal();
  const fs::path folder = fs::is_directory(path) ? path : fs::path();
  const fs::path name = path.has_filename() ? path.stem() : path.parent_path().filename();
  Input input{name.string(), openSource(job), {}, {}, {}};
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
  if (!job.points.empty()) {
    start.points = job.points;
    start.first_frame = 0;
  }
  if (!job.model.empty()) start.model = job.model;
  if (start.points.empty()) {
    const std::string incomplete =
        input.truth.points.empty() ? "" : " (no frame of the truth has all of its parts)";
    throw std::invalid_argument(
        input.name + " has neither ground truth nor an init.yaml that say where the object is" +
        incomplete + ": give --points x,y,x,y,... or --ground-truth");
  }
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
  trackers.push_back(
      makeChainTracker(models.loadFor(start.points, start.model), start.points, job.threads));
  for (const std::string& name : job.baselines) {
    trackers.push_back(makeBaseline(name, firstBox(truth, start)));
  }
  return trackers;
}

/// Index of the last frame that the truth knows of.
int lastOf(const GroundTruth& truth) {
  const int box = truth.boxes.empty() ? -1 : truth.boxes.rbegin()->first;
  const int point = truth.points.empty() ? -1 : truth.points.rbegin()->first;
  return std::max(box, point);
}

void warnOfGaps(const Input& input, const EvaluationResult& result, const EvaluationJob& job) {
  for (const std::string& fault : result.faults) warn(fault);
  if (result.skipped_frames > 0) {
    warn("frames skipped: " + std::to_string(result.skipped_frames) +
         "; the others keep their numbers");
  }
  if (!result.interrupted && job.max_frames == 0) {
    const std::string shortfall = input.frames->shortfall();
    if (!shortfall.empty()) warn(shortfall);
  }
  if (result.interrupted) warn("interrupted: the results are those of the frames so far");
  if (result.dropped_frames > 0) {
    warn("the recorded tracker dropped " + std::to_string(result.dropped_frames) +
         " frames; the figures are those of the others");
  }
  if (input.truth.empty()) {
    warn(input.name + " has no ground truth: there are tracks, but no scores");
    return;
  }
  const auto& frames = result.runs.front().frames;
  if (result.interrupted || job.max_frames > 0 || frames.empty()) return;
  if (lastOf(input.truth) == frames.back().index) return;
  warn(input.name + ": the ground truth ends at frame " + std::to_string(lastOf(input.truth)) +
       ", the frames at " + std::to_string(frames.back().index) + "; only frames with both count");
}

EvaluationResult runTrackers(const EvaluationJob& job, const Input& input,
                             const SequenceStart& start, const EvaluationOptions& options) {
  if (input.recording) {
    const int first = input.recording->frames.begin()->first;
    if (first != start.first_frame) {
      warn("the recorded tracker was started in frame " + std::to_string(first) +
           ", the object is given in frame " + std::to_string(start.first_frame));
    }
    return scoreRecording(*input.frames, input.recording->frames, input.truth, start.points,
                          options);
  }
  return evaluate(*input.frames, makeTrackers(job, input.truth, start), input.truth, start.points,
                  options);
}

/// The script lies beside the programs, in the devel space as in the install space. It is drawn
/// for an interrupted run, too: that is what there is.
void drawReport(const std::string& folder) {
  const fs::path script = fs::read_symlink("/proc/self/exe").parent_path() / "evaluation_report";
  if (runChild({script.string(), folder}, "", [] { return false; }) == 0) return;
  warn("no report.html: " + script.string() + " " + folder + " failed");
}

}  // namespace

void checkGroundTruth(const EvaluationJob& job) {
  if (job.ground_truth.empty()) return;
  if (isTopic(job.ground_truth)) {
    checkRecording(job.bag, job.ground_truth);
  } else {
    GroundTruth truth;
    readTruthFile(job.ground_truth, truth);
  }
}

nlohmann::json runJob(const EvaluationJob& job, const std::function<bool()>& interrupted) {
  const Input input = job.bag.empty() ? openSequence(job) : openBag(job);
  const SequenceStart start = startOf(job, input);
  fs::create_directories(job.out);
  // Of an earlier run, which this one need not write again.
  for (const char* name : {"overlay.mp4", "worst_frames.jpg", "report.html"}) {
    fs::remove(fs::path(job.out) / name);
  }

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
  const EvaluationResult result = runTrackers(job, input, start, options);
  progress.finish();
  warnOfGaps(input, result, job);
  const std::string wanted = input.recording ? input.recording->model : start.model;
  const std::string model = wanted == "auto" ? autoModelName(start.points) : wanted;
  nlohmann::json summary = summaryOf(result, input.name, model);
  if (input.recording) summary["id"] = input.recording->id;
  writeResults(result, summary, job.out);
  writeWorstFrames(*openSource(job), result, input.truth, job.out + "/worst_frames.jpg");
  std::cout << tableOf(summary);
  if (job.report) drawReport(job.out);
  return summary;
}

}  // namespace chain_tracker
