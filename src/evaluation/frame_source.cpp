// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/evaluation/frame_source.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>
#include <vector>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

namespace chain_tracker {
namespace {

namespace fs = std::filesystem;

constexpr double kPictureRate = 30.0;

std::vector<fs::path> filesWith(const fs::path& folder, const std::vector<std::string>& endings) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string ending = entry.path().extension().string();
    if (std::find(endings.begin(), endings.end(), ending) != endings.end()) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

class PictureSource : public FrameSource {
 public:
  explicit PictureSource(std::vector<fs::path> files) : files_(std::move(files)) {}

  bool next(SourceFrame& frame) override {
    if (next_ == files_.size()) return false;
    const std::string path = files_[next_].string();
    frame = {static_cast<int>(next_), static_cast<double>(next_) / kPictureRate,
             cv::imread(path, cv::IMREAD_COLOR), ""};
    if (frame.image.empty()) frame.fault = path + " cannot be read as an image";
    ++next_;
    return true;
  }

  int count() const override { return static_cast<int>(files_.size()); }

 private:
  std::vector<fs::path> files_;
  std::size_t next_ = 0;
};

class VideoSource : public FrameSource {
 public:
  explicit VideoSource(const std::string& path) : video_(path) {
    if (!video_.isOpened()) throw std::invalid_argument(path + " cannot be opened as a video");
    const double rate = video_.get(cv::CAP_PROP_FPS);
    if (rate > 0.0) rate_ = rate;
  }

  bool next(SourceFrame& frame) override {
    cv::Mat image;
    if (!video_.read(image)) return false;
    frame = {next_, next_ / rate_, image, ""};
    ++next_;
    return true;
  }

  /// Containers are often wrong about it, so it serves the progress bar only.
  int count() const override {
    return std::max(0, static_cast<int>(video_.get(cv::CAP_PROP_FRAME_COUNT)));
  }

 private:
  cv::VideoCapture video_;
  double rate_ = kPictureRate;
  int next_ = 0;
};

class GreyFrames : public FrameSource {
 public:
  explicit GreyFrames(std::unique_ptr<FrameSource> frames) : frames_(std::move(frames)) {}

  bool next(SourceFrame& frame) override {
    if (!frames_->next(frame)) return false;
    if (frame.image.channels() != 3) return true;
    cv::Mat grey;
    cv::cvtColor(frame.image, grey, cv::COLOR_BGR2GRAY);
    frame.image = grey;
    return true;
  }

  int count() const override { return frames_->count(); }

 private:
  std::unique_ptr<FrameSource> frames_;
};

}  // namespace

std::unique_ptr<FrameSource> openFrames(const std::string& path) {
  if (!fs::exists(path)) throw std::invalid_argument(path + " does not exist");
  if (!fs::is_directory(path)) return std::make_unique<VideoSource>(path);
  if (fs::is_directory(fs::path(path) / "img")) {
    std::vector<fs::path> pictures =
        filesWith(fs::path(path) / "img", {".jpg", ".png", ".bmp", ".jpeg"});
    if (!pictures.empty()) return std::make_unique<PictureSource>(std::move(pictures));
  }
  const std::vector<fs::path> videos = filesWith(path, {".mp4", ".avi"});
  if (videos.size() == 1) return std::make_unique<VideoSource>(videos.front().string());
  throw std::invalid_argument(path + " has no pictures in img/ and " +
                              std::to_string(videos.size()) +
                              " video files (*.mp4, *.avi), must have one of the two");
}

std::unique_ptr<FrameSource> greyFrames(std::unique_ptr<FrameSource> frames) {
  return std::make_unique<GreyFrames>(std::move(frames));
}

}  // namespace chain_tracker
