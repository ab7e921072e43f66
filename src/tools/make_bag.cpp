// SPDX-License-Identifier: BSD-3-Clause
// Writes a video or a folder of images as a bag of sensor_msgs/Image. The same input gives the same
// bytes: the stamps count from a fixed time.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <cv_bridge/cv_bridge.h>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <ros/names.h>
#include <rosbag/bag.h>
#include <sensor_msgs/image_encodings.h>

namespace fs = std::filesystem;

namespace {

constexpr int kExitGood = 0;
constexpr int kExitBadInput = 2;

/// Not 0, which ROS takes for "no stamp".
constexpr uint64_t kFirstStampNsec = 1'000'000'000;
constexpr double kImageFolderFps = 30.0;

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

bool hasExtension(const fs::path& file, const std::vector<std::string>& extensions) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

/// Files of a folder with one of the extensions, sorted by name; none where there is no folder.
std::vector<fs::path> listFiles(const fs::path& folder,
                                const std::vector<std::string>& extensions) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && hasExtension(entry.path(), extensions)) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Reads the frames of a video, or of a list of image files, one after another.
class FrameSource {
 public:
  explicit FrameSource(const fs::path& video) : name_(video.string()) {
    if (!capture_.open(name_)) refuse(name_, "cannot be read as a video (mp4 or avi)");
    const double fps = capture_.get(cv::CAP_PROP_FPS);
    if (std::isfinite(fps) && fps > 0.0) fps_ = fps;
  }

  explicit FrameSource(std::vector<fs::path> images)
      : images_(std::move(images)), fps_(kImageFolderFps) {}

  /// Empty if the source does not know it.
  std::optional<double> fps() const { return fps_; }

  /// The next frame as BGR; empty after the last one.
  cv::Mat next() {
    cv::Mat frame;
    if (images_.empty()) {
      capture_.read(frame);
    } else if (next_image_ < images_.size()) {
      const std::string file = images_[next_image_++].string();
      frame = cv::imread(file, cv::IMREAD_COLOR);
      if (frame.empty()) refuse(file, "cannot be read as an image (jpg, png or bmp)");
    }
    return frame;
  }

 private:
  std::string name_;
  std::vector<fs::path> images_;
  std::size_t next_image_ = 0;
  cv::VideoCapture capture_;
  std::optional<double> fps_;
};

FrameSource openSequence(const fs::path& folder) {
  std::vector<fs::path> images = listFiles(folder / "img", {".jpg", ".jpeg", ".png", ".bmp"});
  if (!images.empty()) return FrameSource(std::move(images));
  const std::vector<fs::path> videos = listFiles(folder, {".mp4", ".avi"});
  if (videos.size() != 1) {
    refuse(folder.string(), "must hold img/*.jpg|png|bmp or one *.mp4|avi; it holds " +
                                std::to_string(videos.size()) + " videos and no images");
  }
  return FrameSource(videos.front());
}

double chooseFps(const FrameSource& source, const Options& options) {
  if (options.fps > 0.0) return options.fps;
  if (!source.fps()) refuse(options.video, "states no frame rate; give --fps");
  return *source.fps();
}

sensor_msgs::ImagePtr toMsg(const cv::Mat& frame, const ros::Time& stamp,
                            const std::string& frame_id) {
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = frame_id;
  return cv_bridge::CvImage(header, sensor_msgs::image_encodings::BGR8, frame).toImageMsg();
}

/// Returns the number of frames written.
int writeBag(const std::string& file, FrameSource& source, double fps, const Options& options) {
  rosbag::Bag bag(file, rosbag::bagmode::Write);
  int count = 0;
  for (; count < options.max_frames; ++count) {
    const cv::Mat frame = source.next();
    if (frame.empty()) break;
    ros::Time stamp;
    stamp.fromNSec(kFirstStampNsec + static_cast<uint64_t>(std::llround(count * 1e9 / fps)));
    bag.write(options.topic, stamp, toMsg(frame, stamp, options.frame_id));
  }
  return count;
}

void makeBag(const Options& options) {
  std::string fault;
  if (!ros::names::validate(options.topic, fault)) refuse("--topic " + options.topic, fault);
  FrameSource source =
      options.video.empty() ? openSequence(options.sequence) : FrameSource(options.video);
  const double fps = chooseFps(source, options);

  // Under another name until it is whole, so that nobody takes half a bag for the real one.
  const std::string unfinished = options.out + ".part";
  int count = 0;
  try {
    count = writeBag(unfinished, source, fps, options);
    if (count == 0) refuse(options.video + options.sequence, "has no frames");
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
                   "Folder with img/*.jpg|png|bmp, read in the order of their names, or one video")
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
