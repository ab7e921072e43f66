// SPDX-License-Identifier: BSD-3-Clause
// Records what a running tracker publishes about one object: overlay.mp4, objects.csv, parts.csv,
// points.csv and summary.json. Ends by itself when the messages end.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <chain_tracker/TrackedObjectArray.h>
#include <chain_tracker/ros/msg_conversion.h>
#include <cv_bridge/cv_bridge.h>
#include <image_transport/image_transport.h>
#include <opencv2/videoio.hpp>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include "common/node_parameters.h"
#include "common/recorded_objects.h"
#include "common/result_files.h"
#include "common/text_files.h"

namespace fs = std::filesystem;

namespace chain_tracker {
namespace {

constexpr int kExitGood = 0;
constexpr int kExitNothingCame = 1;  // of the object
constexpr int kExitBadInput = 2;

constexpr int kObjectsQueue = 1000;
constexpr int kOverlayQueue = 100;
constexpr double kPollSec = 0.05;

/// So many frames tell the frame rate of the video.
constexpr std::size_t kFramesForRate = 10;
constexpr double kDefaultFps = 30.0;

struct Options {
  std::string dir;
  std::string id;  ///< empty: the first object
  double idle_timeout_sec = 3.0;
  double first_timeout_sec = 30.0;
};

/// A text file that is written line by line; any failure throws with the file's name.
class LineFile {
 public:
  LineFile(const fs::path& file, const std::string& header) : name_(file.string()), out_(file) {
    write(header);
  }

  void write(const std::string& line) {
    out_ << line << std::endl;  // a full disk tells no sooner
    if (!out_) throw std::runtime_error(name_ + ": cannot be written");
  }

 private:
  std::string name_;
  std::ofstream out_;
};

/// A video whose frame rate is taken from the stamps of its first frames.
class OverlayVideo {
 public:
  explicit OverlayVideo(const fs::path& file) : name_(file.string()) {}

  void add(const cv::Mat& frame, double stamp_sec) {
    if (writer_.isOpened()) {
      write(frame);
      return;
    }
    first_frames_.push_back(frame.clone());
    stamps_sec_.push_back(stamp_sec);
    if (first_frames_.size() == kFramesForRate) open();
  }

  void close() {
    if (!writer_.isOpened() && !first_frames_.empty()) open();
    writer_.release();
  }

 private:
  /// The median step, because frames may have been dropped in between.
  double estimateFps() const {
    std::vector<double> steps_sec;
    for (std::size_t k = 1; k < stamps_sec_.size(); ++k) {
      steps_sec.push_back(stamps_sec_[k] - stamps_sec_[k - 1]);
    }
    const double step_sec = percentile(steps_sec, 0.5);
    return step_sec > 0.0 ? std::clamp(1.0 / step_sec, 1.0, 240.0) : kDefaultFps;
  }

  void open() {
    size_ = first_frames_.front().size();
    for (const char* code : {"avc1", "mp4v"}) {  // H.264 plays everywhere, where it can be encoded
      const int fourcc = cv::VideoWriter::fourcc(code[0], code[1], code[2], code[3]);
      if (writer_.open(name_, fourcc, estimateFps(), size_)) break;
    }
    if (!writer_.isOpened()) throw std::runtime_error(name_ + ": cannot be written as a video");
    for (const cv::Mat& frame : first_frames_) write(frame);
    first_frames_.clear();
  }

  void write(const cv::Mat& frame) {
    if (frame.size() == size_) {
      writer_.write(frame);
    } else {
      ROS_WARN_ONCE("overlay changed its size; %s goes on with frames of the first size only",
                    name_.c_str());
    }
  }

  std::string name_;
  cv::VideoWriter writer_;
  cv::Size size_;
  std::vector<cv::Mat> first_frames_;
  std::vector<double> stamps_sec_;
};

ObjectRow toRow(int frame, double time_ms, const TrackedObject& object, const cv::Rect2d& box) {
  ObjectRow row;
  row.frame = frame;
  row.time_ms = time_ms;
  row.state = stateName(object.state);
  row.confidence = object.confidence;
  row.theta = object.pose.theta;
  row.scale = object.scale;
  row.x = row.y = row.w = row.h = std::numeric_limits<double>::quiet_NaN();
  if (box.empty()) return row;
  row.x = box.x;
  row.y = box.y;
  row.w = box.width;
  row.h = box.height;
  return row;
}

class Recorder {
 public:
  Recorder(ros::NodeHandle& node, const Options& options)
      : options_(options),
        objects_(fs::path(options.dir) / "objects.csv", kObjectHeader),
        parts_(fs::path(options.dir) / "parts.csv", kPartHeader),
        points_(fs::path(options.dir) / "points.csv", kPointHeader),
        video_(fs::path(options.dir) / "overlay.mp4"),
        objects_sub_(node.subscribe("objects", kObjectsQueue, &Recorder::recordObjects, this)),
        overlay_sub_(image_transport::ImageTransport(node).subscribe(
            "overlay", kOverlayQueue, &Recorder::recordOverlay, this)) {}

  /// Returns the exit code: bad if no message told of the object.
  int run() {
    const ros::WallTime start = ros::WallTime::now();
    while (ros::ok() && !isOver(start)) {
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kPollSec));
    }
    video_.close();
    if (frame_count_ == 0) {
      ROS_ERROR("no message on %s", objects_sub_.getTopic().c_str());
      return kExitNothingCame;
    }
    if (summary_.frames() == 0) {
      ROS_ERROR("%s", absence().c_str());
      return kExitNothingCame;
    }
    writeSummary();
    return kExitGood;
  }

 private:
  /// In wall time: simulated time stops with the bag.
  bool isOver(const ros::WallTime& start) const {
    const ros::WallTime now = ros::WallTime::now();
    return last_message_.isZero() ? (now - start).toSec() > options_.first_timeout_sec
                                  : (now - last_message_).toSec() > options_.idle_timeout_sec;
  }

  /// Of the object in all messages.
  std::string absence() const {
    const std::string messages = "no message on " + objects_sub_.getTopic() + " told of ";
    if (ids_.empty()) return messages + "an object";
    return messages + "'" + options_.id + "', only of " + namesOf(ids_);
  }

  void recordObjects(const TrackedObjectArray& message) {
    last_message_ = ros::WallTime::now();
    for (const TrackedObject& object : message.objects) ids_.insert(object.id);
    const int frame = frame_count_++;
    const auto object = std::find_if(
        message.objects.begin(), message.objects.end(),
        [this](const TrackedObject& o) { return options_.id.empty() || o.id == options_.id; });
    if (object == message.objects.end()) return;
    options_.id = object->id;
    model_ = object->model;
    const ObjectRow row =
        toRow(frame, message.processing_time.toSec() * 1e3, *object, boxOf(*object));
    summary_.add(row);
    objects_.write(toCsv(row));
    recordParts(frame, *object);
    recordPoints(frame, *object);
  }

  void recordParts(int frame, const TrackedObject& object) {
    int index = 0;
    for (const PartPose& part : object.parts) {
      PartRow row;
      row.frame = frame;
      row.part = index++;
      row.x = part.pose.x;
      row.y = part.pose.y;
      row.theta = part.pose.theta;
      row.size = part.size;
      row.confidence = part.confidence;
      row.visible = part.visible;
      parts_.write(toCsv(row));
    }
  }

  void recordPoints(int frame, const TrackedObject& object) {
    int index = 0;
    for (const TrackedPoint& point : object.points) {
      PointRow row;
      row.frame = frame;
      row.point = index++;
      row.x = point.x;
      row.y = point.y;
      row.confidence = point.confidence;
      row.visible = point.visible;
      points_.write(toCsv(row));
    }
  }

  void recordOverlay(const sensor_msgs::ImageConstPtr& message) {
    last_message_ = ros::WallTime::now();
    video_.add(cv_bridge::toCvShare(message, "bgr8")->image, message->header.stamp.toSec());
  }

  void writeSummary() const {
    nlohmann::json summary = summary_.toJson();
    summary["messages"] = frame_count_;  // those without the object, too
    summary["id"] = options_.id;
    summary["model"] = model_;
    writeJson((fs::path(options_.dir) / "summary.json").string(), summary);
  }

  Options options_;
  LineFile objects_;
  LineFile parts_;
  LineFile points_;
  OverlayVideo video_;
  RunSummary summary_;
  std::string model_;
  std::set<std::string> ids_;  ///< of all objects
  int frame_count_ = 0;
  ros::WallTime last_message_;
  ros::Subscriber objects_sub_;
  image_transport::Subscriber overlay_sub_;
};

Options readOptions(const ros::NodeHandle& node) {
  Options options;
  options.dir = readText(node, "dir");
  if (options.dir.empty()) {
    throw std::runtime_error("~dir is missing: give the folder to write to, _dir:=DIR");
  }
  options.id = readText(node, "id");
  options.idle_timeout_sec = readSeconds(node, "idle_timeout", options.idle_timeout_sec);
  options.first_timeout_sec = readSeconds(node, "first_timeout", options.first_timeout_sec);
  fs::create_directories(options.dir);
  return options;
}

int record() {
  ros::NodeHandle node;
  try {
    Recorder recorder(node, readOptions(ros::NodeHandle("~")));
    return recorder.run();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return kExitBadInput;
  }
}

}  // namespace
}  // namespace chain_tracker

int main(int argc, char** argv) {
  ros::init(argc, argv, "record_results");  // takes its own arguments out, such as _dir:=DIR
  CLI::App app(
      "Records what a tracker publishes on `objects` and `overlay` about one object.\n"
      "Parameters: _dir:=DIR (folder to write), _id:=ID (object; default the first),\n"
      "_idle_timeout:=3 (ends so long after the last message [s]),\n"
      "_first_timeout:=30 (gives up if none has come by then [s]).\n"
      "Exit codes: 0 recorded, 1 no message told of the object, 2 bad parameters or files.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? chain_tracker::kExitGood : chain_tracker::kExitBadInput;
  }
  return chain_tracker::record();
}
