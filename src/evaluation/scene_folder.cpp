// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/evaluation/scene_folder.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include <opencv2/imgcodecs.hpp>

namespace chain_tracker {
namespace {

namespace fs = std::filesystem;

/// A text file that tells when it could not be written.
class TextFile {
 public:
  explicit TextFile(const fs::path& path) : path_(path.string()), stream_(path) {
    stream_ << std::fixed;
    stream_.precision(4);
    check();
  }
  std::ofstream& line() { return stream_; }
  void check() {
    stream_.flush();
    if (!stream_) throw std::runtime_error(path_ + " cannot be written");
  }

 private:
  std::string path_;
  std::ofstream stream_;
};

void writeImage(const cv::Mat3b& image, bool grey, const fs::path& path) {
  cv::Mat written = image;
  if (grey) cv::extractChannel(image, written, 0);
  // Noise hardly compresses: the fastest level is nearly as small.
  bool good = false;
  try {
    good = cv::imwrite(path.string(), written, {cv::IMWRITE_PNG_COMPRESSION, 1});
  } catch (const cv::Exception&) {
    good = false;
  }
  if (!good) throw std::runtime_error(path.string() + " cannot be written");
}

fs::path picturePath(const fs::path& out, int index) {
  return out / "img" / cv::format("%06d.png", index);
}

/// Pictures of an earlier, longer scene would be taken for frames of this one. Only files that such
/// a scene wrote are removed: those that follow without a gap.
void removePicturesFrom(int index, const fs::path& out) {
  while (fs::remove(picturePath(out, index))) ++index;
}

void writeInit(const SyntheticScene& scene, const std::vector<cv::Point2d>& points,
               const fs::path& path) {
  TextFile file(path);
  file.line() << "model: " << scene.model() << "\npoints: [";
  for (size_t i = 0; i < points.size(); ++i) {
    file.line() << (i > 0 ? ", " : "") << "[" << points[i].x << ", " << points[i].y << "]";
  }
  file.line() << "]\nfirst_frame: 0\n";
  file.check();
}

void addTruth(const SceneFrame& frame, int index, TextFile& parts, TextFile& boxes,
              TextFile& segments) {
  for (size_t part = 0; part < frame.points.size(); ++part) {
    parts.line() << index << "," << part << "," << frame.points[part].x << ","
                 << frame.points[part].y << "," << (frame.visible[part] ? 1 : 0) << "\n";
  }
  for (size_t i = 0; i < frame.segments.size(); ++i) {
    const Similarity& segment = frame.segments[i];
    segments.line() << index << "," << i << "," << segment.translation.x << ","
                    << segment.translation.y << "," << segment.angle << "," << segment.scale
                    << "\n";
  }
  if (frame.in_view) {
    boxes.line() << frame.box.x << "," << frame.box.y << "," << frame.box.width << ","
                 << frame.box.height << "\n";
  } else {
    boxes.line() << "NaN,NaN,NaN,NaN\n";
  }
}

}  // namespace

void writeSceneFolder(const SyntheticScene& scene, const SceneOptions& options,
                      const std::string& folder, const std::function<void(int)>& progress) {
  const fs::path out(folder);
  std::error_code error;
  fs::create_directories(out / "img", error);
  if (error) throw std::runtime_error((out / "img").string() + " cannot be made");
  TextFile parts(out / "groundtruth_parts.csv");
  TextFile boxes(out / "groundtruth_rect.txt");
  TextFile segments(out / "groundtruth_segments.csv");
  parts.line() << "frame,part,x,y,visible\n";
  segments.line() << "frame,segment,x,y,theta,scale\n";
  for (int index = 0; index < options.frames; ++index) {
    const SceneFrame frame = scene.render(index);
    if (index == 0) writeInit(scene, frame.points, out / "init.yaml");
    writeImage(frame.image, options.grey, picturePath(out, index));
    addTruth(frame, index, parts, boxes, segments);
    progress(index + 1);
  }
  removePicturesFrom(options.frames, out);
  parts.check();
  boxes.check();
  segments.check();
}

}  // namespace chain_tracker
