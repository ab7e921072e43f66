// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/evaluation/frame_source.h"

#include <algorithm>
#include <cctype>
#include <cmath>
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

/// The name with its numbers filled up with zeros, so that 2 sorts before 10.
std::string naturalKey(const std::string& name) {
  constexpr std::size_t kDigits = 20;
  std::string key;
  for (std::size_t begin = 0; begin < name.size();) {
    const std::size_t end = std::min(name.find_first_not_of("0123456789", begin), name.size());
    const std::size_t digits = end - begin;
    if (digits > 0 && digits < kDigits) key.append(kDigits - digits, '0');
    key.append(name, begin, std::max<std::size_t>(digits, 1));
    begin += std::max<std::size_t>(digits, 1);
  }
  return key;
}

bool endsIn(const std::vector<std::string>& endings, const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

/// Files of the folder with one of the endings, in lower or upper case, in natural order.
std::vector<fs::path> filesWith(const fs::path& folder, const std::vector<std::string>& endings) {
  std::vector<std::pair<std::string, fs::path>> keyed;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!entry.is_regular_file() || !endsIn(endings, entry.path())) continue;
    keyed.emplace_back(naturalKey(entry.path().filename().string()), entry.path());
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<fs::path> files;
  files.reserve(keyed.size());
  for (const auto& [key, file] : keyed) files.push_back(file);
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
  double rate() const override { return kPictureRate; }

 private:
  std::vector<fs::path> files_;
  std::size_t next_ = 0;
};

class VideoSource : public FrameSource {
 public:
  explicit VideoSource(const std::string& path) : path_(path), video_(path) {
    if (!video_.isOpened()) throw std::invalid_argument(path + " cannot be opened as a video");
    const double rate = video_.get(cv::CAP_PROP_FPS);
    if (std::isfinite(rate) && rate > 0.0) rate_ = rate;
  }

  bool next(SourceFrame& frame) override {
    if (ahead_.empty() && !readAhead()) return false;
    frame = {next_, next_ / (rate_ > 0.0 ? rate_ : kPictureRate), cv::Mat(), ""};
    if (unreadable_ > 0) {
      frame.fault = "frame " + std::to_string(next_) + " of " + path_ + " cannot be decoded";
      --unreadable_;
    } else {
      cv::swap(frame.image, ahead_);
    }
    ++next_;
    return true;
  }

  double rate() const override { return rate_; }

  /// Containers are often wrong about it: it bounds the search for further frames, no more.
  int count() const override {
    return std::max(0, static_cast<int>(video_.get(cv::CAP_PROP_FRAME_COUNT)));
  }

  /// Decoders leave out some damaged frames without a word, so that the later ones move up.
  std::string shortfall() const override {
    if (next_ >= count()) return "";
    return path_ + " promises " + std::to_string(count()) + " frames, only " +
           std::to_string(next_) +
           " came: if it is damaged, frames behind the damage may have numbers that are too low";
  }

 private:
  /// Reads on to the next frame that can be decoded; false if there is none. Only a frame behind
  /// them shows that those that could not be read are there at all.
  bool readAhead() {
    while (!video_.read(ahead_)) {
      ++unreadable_;
      if (next_ + unreadable_ < count()) continue;
      unreadable_ = 0;
      return false;
    }
    return true;
  }

  std::string path_;
  cv::VideoCapture video_;
  cv::Mat ahead_;       // behind the unreadable frames
  int unreadable_ = 0;  // frames from next_ on
  double rate_ = 0.0;   // unless it tells one
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
  double rate() const override { return frames_->rate(); }
  std::string shortfall() const override { return frames_->shortfall(); }

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
