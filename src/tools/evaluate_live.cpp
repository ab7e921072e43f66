// SPDX-License-Identifier: BSD-3-Clause
/// Records what a running tracker publishes on `objects` while a bag is played, then scores it as
/// `evaluate --recording` does. Ends by itself, with the bag's last image or with the messages.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <rosbag/bag.h>

#include "chain_tracker/TrackedObjectArray.h"
#include "chain_tracker/ros/parameters.h"
#include "common/bag_frames.h"
#include "common/evaluation_job.h"
#include "common/node_parameters.h"

namespace fs = std::filesystem;

namespace chain_tracker {
namespace {

constexpr int kGood = 0;
constexpr int kBelowThreshold = 1;
constexpr int kBadInput = 2;

/// Long enough for a message of every frame of a long bag: none may be lost here.
constexpr int kQueueSize = 100000;
constexpr double kPollSec = 0.02;
/// Of the longest pause between two images: messages may come late.
constexpr double kPatience = 2.0;

struct Options {
  EvaluationJob job;
  double idle_timeout_sec = 5.0;
  double first_timeout_sec = 60.0;
  double rate = 1.0;
  double min_iou = std::nan("");
};

std::vector<cv::Point2d> pointsFrom(const std::string& text) {
  if (text.empty()) return {};
  if (const auto points = pointsFromText(text)) return *points;
  throw std::invalid_argument("~points is '" + text +
                              "', must be empty or at least two points x,y,x,y,... [px]");
}

std::string requiredParam(const ros::NodeHandle& node, const std::string& key) {
  std::string value = readText(node, key);
  if (!value.empty()) return value;
  throw std::invalid_argument("~" + key + " is missing");
}

Options readOptions(const ros::NodeHandle& node) {
  Options options;
  options.job.bag = requiredParam(node, "bag");
  options.job.topic = requiredParam(node, "topic");
  options.job.out = requiredParam(node, "out");
  options.job.recording = (fs::path(options.job.out) / "objects.bag").string();
  options.job.id = readText(node, "id");
  options.job.ground_truth = readText(node, "ground_truth");
  options.job.points = pointsFrom(readText(node, "points"));
  options.job.video = readParameter(node, "video", false, "true or false");
  options.min_iou = readParameter(node, "min_iou", options.min_iou, "a number");
  options.idle_timeout_sec = readSeconds(node, "idle_timeout", options.idle_timeout_sec);
  options.first_timeout_sec = readSeconds(node, "first_timeout", options.first_timeout_sec);
  options.rate = readParameter(node, "rate", options.rate, "a number");
  if (!(options.rate > 0.0)) {
    throw std::invalid_argument("~rate is " + std::to_string(options.rate) +
                                ", must be above 0: the speed at which the bag is played");
  }
  return options;
}

/// Writes every message on `objects` into a bag. What comes before run() is kept for it.
class ObjectsRecorder {
 public:
  explicit ObjectsRecorder(ros::NodeHandle& node)
      : subscriber_(node.subscribe("objects", kQueueSize, &ObjectsRecorder::record, this)) {}

  /// `last_stamp`: of the image after which no message comes. Returns when there is nothing more to
  /// record, in wall time: simulated time stops with the bag.
  void run(const EvaluationJob& job, const ros::Time& last_stamp, double first_timeout_sec,
           double idle_timeout_sec) {
    topic_ = job.recorded_topic;
    last_stamp_ = last_stamp;
    bag_.open(job.recording, rosbag::bagmode::Write);
    ros::WallTime since = ros::WallTime::now();
    int known = 0;
    while (ros::ok() && !ended_) {
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kPollSec));
      const ros::WallTime now = ros::WallTime::now();
      if (count_ > known) since = now;
      known = count_;
      const double patience = count_ == 0 ? first_timeout_sec : idle_timeout_sec;
      if ((now - since).toSec() > patience) break;
    }
    if (count_ == 0) throw std::runtime_error("no message on " + subscriber_.getTopic());
    if (ros::ok() && !ended_) {
      std::cerr << "evaluate_live: no message on " << subscriber_.getTopic() << " for "
                << idle_timeout_sec << " s though images are left, which count as dropped\n";
    }
    bag_.close();
  }

 private:
  void record(const TrackedObjectArray& objects) {
    ++count_;
    ended_ = objects.header.stamp == last_stamp_;
    // Stamped as the image: the order is that of the frames, whatever time it is here.
    bag_.write(topic_, objects.header.stamp, objects);
  }

  std::string topic_;
  ros::Time last_stamp_;
  rosbag::Bag bag_;
  int count_ = 0;
  bool ended_ = false;
  ros::Subscriber subscriber_;
};

ros::Time stampOfLast(const std::map<ros::Time, int>& index_of) {
  const auto last =
      std::max_element(index_of.begin(), index_of.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return last->first;
}

int recordAndScore() {
  ros::NodeHandle node;
  const Options options = readOptions(ros::NodeHandle("~"));
  checkGroundTruth(options.job);   // before the bag is played, which may take long
  ObjectsRecorder recorder(node);  // the bag may be playing before its stamps are read
  const std::map<ros::Time, int> index_of = indexByOwnStamps(options.job.bag, options.job.topic);
  if (index_of.empty()) throw std::invalid_argument(options.job.bag + " has no images");
  fs::create_directories(options.job.out);
  const double pause = kPatience * longestPause(index_of) / options.rate;
  recorder.run(options.job, stampOfLast(index_of), options.first_timeout_sec,
               std::max(options.idle_timeout_sec, pause));
  const bool interrupted = !ros::ok();
  // What has been recorded is scored all the same, which takes no longer than reading the bag.
  const nlohmann::json summary = runJob(options.job, [] { return false; });
  if (interrupted) return kBadInput;
  if (std::isnan(options.min_iou)) return kGood;
  const nlohmann::json& iou = summary["mean_iou"];
  return !iou.is_null() && iou.get<double>() >= options.min_iou ? kGood : kBelowThreshold;
}

}  // namespace
}  // namespace chain_tracker

int main(int argc, char** argv) {
  ros::init(argc, argv, "evaluate_live");  // takes its own arguments out, such as _bag:=FILE
  CLI::App app(
      "Records what a tracker publishes on `objects` while a bag is played, and scores it.\n"
      "Parameters: _bag:=FILE and _topic:=TOPIC (that are played), _out:=DIR (folder to write),\n"
      "_id:=ID (object; default the first), _ground_truth:=FILE|TOPIC,\n"
      "_points:=x,y,... (where the tracker is started), _video:=true,\n"
      "_min_iou:=X, _rate:=1 (speed at which the bag is played),\n"
      "_idle_timeout:=5 (ends so long after the last message [s], but never before\n"
      "twice the longest pause between two images),\n"
      "_first_timeout:=60 (gives up if none has come by then [s]).\n"
      "Exit codes: 0 scored, 1 the mean IoU is below ~min_iou, 2 bad input or no message.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? chain_tracker::kGood : chain_tracker::kBadInput;
  }
  try {
    return chain_tracker::recordAndScore();
  } catch (const std::exception& error) {
    std::cerr << "evaluate_live: " << error.what() << "\n";
    return chain_tracker::kBadInput;
  }
}
