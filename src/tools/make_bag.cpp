// SPDX-License-Identifier: BSD-3-Clause
// Writes a video or a folder of images as a bag of sensor_msgs/Image. The same input gives the same
// bytes: the stamps count from a fixed time.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>
#include <cv_bridge/cv_bridge.h>
#include <opencv2/core/utils/logger.hpp>
#include <ros/names.h>
#include <rosbag/bag.h>
#include <sensor_msgs/image_encodings.h>

#include "chain_tracker/evaluation/frame_source.h"
#include "common/free_space.h"

namespace fs = std::filesystem;

namespace {

using chain_tracker::FrameSource;
using chain_tracker::SourceFrame;

constexpr int kExitGood = 0;
constexpr int kExitBadInput = 2;

/// Not 0, which ROS takes for "no stamp".
constexpr uint64_t kFirstStampNsec = 1'000'000'000;

struct Options {
  std::string video;
  std::string sequence;
  std::string topic = "/camera/image_raw";
  std::string frame_id = "camera";
  std::string out;
  double fps = 0.0;  ///< 0: the video's own
  int max_frames = std::numeric_limits<int>::max();
};

[[noreturn]] void refuse(const std::string& file, const std::string& fault) {
  throw std::runtime_error(file + ": " + fault);
}

void warn(const std::string& message) { std::cerr << "make_bag: " << message << "\n"; }

double chooseFps(const FrameSource& source, const Options& options) {
  if (options.fps > 0.0) return options.fps;
  if (source.rate() > 0.0) return source.rate();
  refuse(options.video + options.sequence, "states no frame rate; give --fps");
}

sensor_msgs::ImagePtr toMsg(const cv::Mat& frame, const ros::Time& stamp,
                            const std::string& frame_id) {
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = frame_id;
  return cv_bridge::CvImage(header, sensor_msgs::image_encodings::BGR8, frame).toImageMsg();
}

/// A bag holds every pixel: a video of a few megabytes can fill a disk.
void requireRoom(const std::string& input, const Options& options) {
  const std::unique_ptr<FrameSource> source = chain_tracker::openFrames(input);
  SourceFrame first;
  while (first.image.empty()) {
    if (!source->next(first)) return;
  }
  const auto frames = static_cast<uintmax_t>(std::min(source->count(), options.max_frames));
  chain_tracker::requireSpace(options.out, frames * first.image.total() * first.image.elemSize());
}

/// Returns the number of frames written. One that cannot be read is told and left out: the others
/// keep their stamps.
int writeFrames(rosbag::Bag& bag, FrameSource& source, double fps, const Options& options) {
  int count = 0;
  SourceFrame frame;
  while (count < options.max_frames && source.next(frame)) {
    if (!frame.fault.empty()) {
      warn("left out, later frames have lower numbers in the bag: " + frame.fault);
      continue;
    }
    ros::Time stamp;
    stamp.fromNSec(kFirstStampNsec + static_cast<uint64_t>(std::llround(frame.index * 1e9 / fps)));
    bag.write(options.topic, stamp, toMsg(frame.image, stamp, options.frame_id));
    ++count;
  }
  if (count < options.max_frames && !source.shortfall().empty()) warn(source.shortfall());
  return count;
}

int writeBag(const std::string& file, FrameSource& source, double fps, const Options& options) {
  auto bag = std::make_unique<rosbag::Bag>(file, rosbag::bagmode::Write);
  try {
    const int count = writeFrames(*bag, source, fps, options);
    bag->close();
    return count;
  } catch (const rosbag::BagIOException& error) {
    // Its destructor would write on, and end the process.
    static_cast<void>(bag.release());
    refuse(options.out, error.what());
  }
}

void makeBag(const Options& options) {
  std::string fault;
  if (!ros::names::validate(options.topic, fault)) refuse("--topic " + options.topic, fault);
  const std::string& input = options.video.empty() ? options.sequence : options.video;
  const std::unique_ptr<FrameSource> source = chain_tracker::openFrames(input);
  const double fps = chooseFps(*source, options);
  requireRoom(input, options);

  // Under another name until it is whole, so that nobody takes half a bag for the real one.
  const std::string unfinished = options.out + ".part";
  int count = 0;
  try {
    count = writeBag(unfinished, *source, fps, options);
    if (count == 0) refuse(input, "has no frames");
  } catch (const std::exception&) {
    fs::remove(unfinished);
    throw;
  }
  fs::rename(unfinished, options.out);
  std::cout << options.out << ": " << count << " frames at " << fps << " fps on " << options.topic
            << "\n";
}

void describeOptions(CLI::App& app, Options& options) {
  CLI::Option_group* input = app.add_option_group("input");
  input->add_option("--video", options.video, "Video file, mp4 or avi")->check(CLI::ExistingFile);
  input
      ->add_option("--sequence", options.sequence,
                   "Folder with img/*.jpg|jpeg|png|bmp, in natural order (2.png before 10.png), or "
                   "one video")
      ->check(CLI::ExistingDirectory);
  input->require_option(1);
  app.add_option("--topic", options.topic, "Topic of the images")->capture_default_str();
  app.add_option("--frame-id", options.frame_id, "Frame of the camera")->capture_default_str();
  app.add_option("--fps", options.fps, "Frames a second (default: the video's own; images: 30)")
      ->check(CLI::Range(0.1, 1000.0));
  app.add_option("--max-frames", options.max_frames, "Stop after so many frames")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  app.add_option("--out", options.out, "Bag to write")->required();
}

}  // namespace

int main(int argc, char** argv) {
  // What OpenCV tries in vain before it finds a reader is no fault of the user's.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);

  Options options;
  CLI::App app("Writes a video or a folder of images as a bag of sensor_msgs/Image (bgr8).");
  describeOptions(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitGood : kExitBadInput;
  }
  try {
    makeBag(options);
  } catch (const std::exception& error) {
    std::cerr << "make_bag: " << error.what() << "\n";
    return kExitBadInput;
  }
  return kExitGood;
}
