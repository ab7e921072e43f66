// SPDX-License-Identifier: BSD-3-Clause
/// Scores the chain tracker, beside OpenCV's trackers, on sequences and bags.
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <opencv2/core.hpp>
#include <ros/package.h>

#include "chain_tracker/evaluation/evaluated_tracker.h"
#include "common/evaluation_files.h"
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
  std::vector<double> coordinates;
  double min_iou = std::nan("");
  bool report = true;
};

std::vector<cv::Point2d> pointsOf(const std::vector<double>& coordinates) {
  if (coordinates.size() % 2 != 0) {
    throw std::invalid_argument("--points has " + std::to_string(coordinates.size()) +
                                " numbers, must be pairs x,y,x,y,...");
  }
  std::vector<cv::Point2d> points;
  for (std::size_t i = 0; i < coordinates.size(); i += 2) {
    points.emplace_back(coordinates[i], coordinates[i + 1]);
  }
  return points;
}

void addOptions(CLI::App& app, Options& options) {
  EvaluationJob& job = options.job;
  auto* sequence = app.add_option("--sequence", job.sequence, "Sequence folder or video file");
  auto* bag = app.add_option("--bag", job.bag, "Bag to read the images from");
  auto* suite = app.add_option("--suite", options.suite, "Folder of sequence folders: runs all");
  sequence->excludes(bag)->excludes(suite);
  bag->excludes(suite);
  app.add_option("--topic", job.topic, "Image topic of the bag")->needs(bag);
  app.add_option("--ground-truth", job.ground_truth,
                 "groundtruth_rect.txt or groundtruth_parts.csv, or a recorded TrackedObjectArray "
                 "topic of the bag (default: the sequence folder's)")
      ->excludes(suite);
  app.add_option("--model", job.model, "Model: name, YAML file or auto (default: init.yaml's)");
  app.add_option("--points", options.coordinates, "Where the object is: x,y,x,y,...")
      ->delimiter(',')
      ->excludes(suite);
  app.add_option("--baselines", job.baselines, "OpenCV's trackers to compare with")
      ->delimiter(',')
      ->check(CLI::IsMember(chain_tracker::baselineNames()));
  app.add_option("--max-frames", job.max_frames, "Stop after so many frames (0: all)")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--jobs", options.parallel_jobs, "Sequences of a suite run at once")
      ->check(CLI::PositiveNumber)
      ->needs(suite);
  app.add_option("--min-iou", options.min_iou, "Exit with 1 if the mean IoU is below");
  app.add_flag("--video", job.video, "Write overlay.mp4");
  app.add_flag("!--no-report", options.report, "Do not draw report.html");
  app.add_option("--out", job.out, "Folder to write")->required();
}

void drawReport(const std::string& folder) {
  const std::string script = ros::package::getPath("chain_tracker") + "/scripts/evaluation_report";
  const std::string command = "/usr/bin/python3 '" + script + "' '" + folder + "'";
  if (std::system(command.c_str()) != 0) {
    std::cerr << "evaluate: no report: " << command << " failed\n";
  }
}

int judge(const nlohmann::json& summary, double min_iou) {
  if (std::isnan(min_iou)) return kGood;
  const auto& iou = summary["mean_iou"];
  return !iou.is_null() && iou.get<double>() >= min_iou ? kGood : kBelowThreshold;
}

int run(Options& options, const std::string& program) {
  EvaluationJob& job = options.job;
  cv::setNumThreads(1);
  if (!options.suite.empty()) {
    return chain_tracker::runSuite(options.suite, job, options.parallel_jobs, program) ? kGood
                                                                                       : kBadInput;
  }
  if (job.sequence.empty() && job.bag.empty()) {
    throw std::invalid_argument("one of --sequence, --bag and --suite is needed");
  }
  if (!job.bag.empty() && job.topic.empty()) {
    throw std::invalid_argument("--bag needs --topic");
  }
  job.points = pointsOf(options.coordinates);
  const nlohmann::json summary = chain_tracker::runJob(job, [] { return interrupted != 0; });
  std::cout << chain_tracker::tableOf(summary);
  if (options.report) drawReport(job.out);
  return judge(summary, options.min_iou);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Scores the chain tracker, beside OpenCV's trackers, on a sequence, a bag or a suite.");
  Options options;
  addOptions(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kGood : kBadInput;
  }
  std::signal(SIGINT, onInterrupt);
  try {
    return run(options, std::filesystem::read_symlink("/proc/self/exe").string());
  } catch (const std::exception& error) {
    std::cerr << "evaluate: " << error.what() << "\n";
    return kBadInput;
  }
}
