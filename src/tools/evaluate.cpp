// SPDX-License-Identifier: BSD-3-Clause
/// Scores the chain tracker, beside OpenCV's trackers, on sequences and bags.
#include <cmath>
#include <csignal>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <opencv2/core.hpp>

#include "chain_tracker/chain/target_checks.h"
#include "chain_tracker/evaluation/evaluated_tracker.h"
#include "chain_tracker/ros/parameters.h"
#include "common/evaluation_job.h"
#include "common/evaluation_suite.h"

namespace {

using chain_tracker::EvaluationJob;

constexpr int kGood = 0;
constexpr int kBelowThreshold = 1;
constexpr int kBadInput = 2;

volatile std::sig_atomic_t interrupted = 0;

void onInterrupt(int) { interrupted = 1; }

struct Options {
  EvaluationJob job;
  std::string suite;
  int parallel_jobs = 1;
  std::string points;  ///< x,y,x,y,...; empty: none are given
  double min_iou = std::nan("");
};

std::vector<cv::Point2d> pointsOf(const std::string& text) {
  if (text.empty()) return {};
  if (const auto points = chain_tracker::pointsFromText(text)) return *points;
  throw std::invalid_argument("--points is '" + text +
                              "', must be at least two points x,y,x,y,... [px]");
}

void addOptions(CLI::App& app, Options& options) {
  EvaluationJob& job = options.job;
  auto* sequence = app.add_option(
      "--sequence", job.sequence,
      "Sequence folder, its pictures in natural order (2.png before 10.png), or video file");
  auto* bag = app.add_option("--bag", job.bag, "Bag to read the images from");
  auto* suite = app.add_option("--suite", options.suite, "Folder of sequence folders: runs all");
  sequence->excludes(bag)->excludes(suite);
  bag->excludes(suite);
  auto* topic = app.add_option("--topic", job.topic, "Image topic of the bag")->needs(bag);
  bag->needs(topic);
  auto* recording =
      app.add_option("--recording", job.recording,
                     "Bag of the objects a live tracker published on the images of --bag: scores "
                     "these instead of running the tracker")
          ->needs(bag);
  app.add_option("--recorded-topic", job.recorded_topic, "Topic of the objects in that bag")
      ->capture_default_str()
      ->needs(recording);
  app.add_option("--id", job.id, "Object in that bag (default: the first that was told of)")
      ->needs(recording);
  app.add_option("--ground-truth", job.ground_truth,
                 "groundtruth_rect.txt or groundtruth_parts.csv, or a recorded TrackedObjectArray "
                 "topic of the bag (default: the sequence folder's)")
      ->excludes(suite);
  app.add_option("--model", job.model, "Model: name, YAML file or auto (default: init.yaml's)");
  app.add_option("--points", options.points, "Where the object is in frame 0: x,y,x,y,... [px]")
      ->excludes(suite);
  app.add_option("--baselines", job.baselines, "OpenCV's trackers to compare with")
      ->delimiter(',')
      ->excludes(recording)
      ->check(CLI::IsMember(chain_tracker::baselineNames()));
  app.add_option("--max-frames", job.max_frames, "Stop after so many frames (0: all)")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()));
  app.add_option("--threads", job.threads, "Threads that an update may use, the baselines' too")
      ->check(CLI::Range(1, chain_tracker::kMostThreads))
      ->capture_default_str();
  app.add_option("--jobs", options.parallel_jobs, "Sequences of a suite run at once")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()))
      ->needs(suite);
  app.add_option("--min-iou", options.min_iou,
                 "Exit with 1 if the mean IoU (of a suite: over its sequences) is below");
  app.add_flag("--grey", job.grey, "Turn the images grey first, as of a mono8 camera");
  app.add_flag("--video", job.video, "Write overlay.mp4");
  app.add_flag("!--no-report", job.report, "Do not draw report.html");
  app.add_option("--out", job.out, "Folder to write")->required();
}

int judge(const nlohmann::json& mean_iou, bool complete, double min_iou) {
  if (!complete) return kBadInput;
  if (std::isnan(min_iou)) return kGood;
  return !mean_iou.is_null() && mean_iou.get<double>() >= min_iou ? kGood : kBelowThreshold;
}

int run(Options& options) {
  EvaluationJob& job = options.job;
  const auto is_interrupted = [] { return interrupted != 0; };
  cv::setNumThreads(job.threads);
  if (!options.suite.empty()) {
    const chain_tracker::SuiteResult result =
        chain_tracker::runSuite(options.suite, job, options.parallel_jobs, is_interrupted);
    return judge(result.mean_iou, result.complete, options.min_iou);
  }
  if (job.sequence.empty() && job.bag.empty()) {
    throw std::invalid_argument("one of --sequence, --bag and --suite is needed");
  }
  job.points = pointsOf(options.points);
  const nlohmann::json summary = chain_tracker::runJob(job, is_interrupted);
  return judge(summary["mean_iou"], !summary["interrupted"], options.min_iou);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Scores the chain tracker, beside OpenCV's trackers, on a sequence, a bag or a suite.");
  app.footer(
      "Writes objects.csv, parts.csv, points.csv, scores.csv, summary.json and report.html.\n"
      "Exit codes: 0 good; 1 below --min-iou; 2 wrong usage, bad input or interrupted (what there "
      "is by then is written).");
  Options options;
  addOptions(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kGood : kBadInput;
  }
  std::signal(SIGINT, onInterrupt);
  try {
    return run(options);
  } catch (const std::exception& error) {
    std::cerr << "evaluate: " << error.what() << "\n";
    return kBadInput;
  }
}
