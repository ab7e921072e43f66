// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/evaluation/ground_truth.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>

#include <yaml-cpp/yaml.h>

#include "chain_tracker/image/pixel_geometry.h"
#include "yaml/yaml_document.h"

namespace chain_tracker {
namespace {

namespace fs = std::filesystem;

/// What rounding may move corners by [px].
constexpr double kWholePixel = 1.0;

[[noreturn]] void refuse(const std::string& path, int line, const std::string& reason) {
  throw std::invalid_argument(path + ":" + std::to_string(line) + ": " + reason);
}

std::ifstream openText(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::invalid_argument("ground truth " + path + " cannot be read");
  return file;
}

bool isBlank(const std::string& line) {
  return line.find_first_not_of(" \t\r") == std::string::npos;
}

/// Numbers separated by commas, tabs or spaces.
std::vector<double> numbersIn(const std::string& line, const std::string& path, int number) {
  std::string text = line;
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == ',' || c == '\t' || c == '\r'; }, ' ');
  std::vector<double> numbers;
  const char* rest = text.c_str();
  while (true) {
    char* end = nullptr;
    const double value = std::strtod(rest, &end);
    if (end == rest) break;
    numbers.push_back(value);
    rest = end;
  }
  if (!isBlank(rest)) refuse(path, number, "'" + line + "' has something that is no number");
  return numbers;
}

bool hasNan(const std::vector<double>& numbers) {
  return std::any_of(numbers.begin(), numbers.end(), [](double x) { return std::isnan(x); });
}

/// Not known is NaN; nothing lies at infinity.
void refuseInfinite(const std::vector<double>& numbers, const std::string& line,
                    const std::string& path, int number) {
  if (std::none_of(numbers.begin(), numbers.end(), [](double x) { return std::isinf(x); })) return;
  refuse(path, number, "'" + line + "' has an infinite number, must be finite or NaN");
}

constexpr int kHighestIndex = std::numeric_limits<int>::max();

bool isIndex(double number) {
  return number >= 0.0 && number <= kHighestIndex && number == std::floor(number);
}

int indexFrom(double number, const std::string& name, const std::string& path, int line) {
  if (isIndex(number)) return static_cast<int>(number);
  std::ostringstream reason;
  reason << name << " is " << number << ", must be a whole number in [0, " << kHighestIndex << "]";
  refuse(path, line, reason.str());
}

std::vector<cv::Point2d> cornersIn(const std::vector<double>& n) {
  return {{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}, {n[6], n[7]}};
}

std::vector<cv::Point2d> cornersOf(const cv::Rect2d& box) {
  const cv::Point2d high = box.br();
  return {box.tl(), {high.x, box.y}, high, {box.x, high.y}};
}

/// Whether the sides are parallel to the image's.
bool isUpright(const std::vector<cv::Point2d>& corners) {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const cv::Point2d side = corners[(k + 1) % corners.size()] - corners[k];
    if (std::min(std::abs(side.x), std::abs(side.y)) > kWholePixel) return false;
  }
  return true;
}

int lineOf(const YAML::Node& node) { return node.Mark().line + 1; }

template <typename Value>
Value valueOf(const YAML::Node& node, const std::string& name, const std::string& kind,
              const std::string& path, int line) {
  Value value;
  if (YAML::convert<Value>::decode(node, value)) return value;
  std::ostringstream reason;
  reason << name << " is '" << node << "', must be " << kind;
  refuse(path, line, reason.str());
}

double coordinateIn(const YAML::Node& node, const std::string& path) {
  return valueOf<double>(node, "a coordinate of points", "a number", path, lineOf(node));
}

std::vector<cv::Point2d> pointsIn(const YAML::Node& node, const std::string& path, int line) {
  if (!node.IsSequence()) refuse(path, line, "points must be a list [[x, y], ...]");
  std::vector<cv::Point2d> points;
  for (const YAML::Node& point : node) {
    if (!point.IsSequence() || point.size() != 2) {
      refuse(path, lineOf(point), "a point must be [x, y]");
    }
    points.emplace_back(coordinateIn(point[0], path), coordinateIn(point[1], path));
  }
  return points;
}

int firstFrameIn(const YAML::Node& node, const std::string& path, int line) {
  const int frame = valueOf<int>(node, "first_frame", "a whole number", path, line);
  if (frame >= 0) return frame;
  refuse(path, line, "first_frame is " + std::to_string(frame) + ", must be at least 0");
}

/// A file lies where the init file says, seen from its folder; anything else is a name.
std::string modelFrom(const std::string& name_or_file, const std::string& path) {
  const fs::path file(name_or_file);
  if (file.extension() != ".yaml" || file.is_absolute()) return name_or_file;
  return (fs::path(path).parent_path() / file).string();
}

/// What init.yaml says.
struct Init {
  SequenceStart start;
  int first_frame_line = 0;  ///< 0: it does not say first_frame
};

/// `line`: of the key. A value that is left out is said to lie in a later one.
void readInitKey(const std::string& key, const YAML::Node& value, const std::string& path, int line,
                 Init& init) {
  SequenceStart& start = init.start;
  if (key == "model") {
    start.model = modelFrom(valueOf<std::string>(value, key, "text", path, line), path);
  } else if (key == "first_frame") {
    start.first_frame = firstFrameIn(value, path, line);
    init.first_frame_line = line;
  } else if (key == "points") {
    start.points = pointsIn(value, path, line);
  } else {
    refuse(path, line, "unknown key '" + key + "', must be one of: first_frame, model, points");
  }
}

Init readInit(const std::string& path) {
  Init init;
  try {
    const YAML::Node document = parseYamlDocument(textOfFile(path, "init"), path);
    if (!document.IsNull() && !document.IsMap()) {
      refuse(path, lineOf(document), "must be a map of the keys first_frame, model, points");
    }
    std::set<std::string> seen;
    for (const auto& entry : document) {
      const int line = lineOf(entry.first);
      const std::string key = valueOf<std::string>(entry.first, "a key", "text", path, line);
      if (!seen.insert(key).second) refuse(path, line, "key '" + key + "' is there twice");
      readInitKey(key, entry.second, path, line, init);
    }
  } catch (const YAML::Exception& error) {
    refuse(path, error.mark.line + 1, error.msg);
  }
  return init;
}

/// All parts of the frame in order; empty unless all are there.
std::vector<cv::Point2d> partsAt(int frame, std::size_t count, const GroundTruth& truth) {
  std::vector<cv::Point2d> parts;
  const auto points = truth.points.find(frame);
  if (points == truth.points.end() || points->second.size() != count) return parts;
  parts.reserve(count);
  for (const auto& point : points->second) parts.push_back(point.second.position);
  return parts;
}

std::vector<cv::Point2d> boxAt(int frame, const GroundTruth& truth) {
  const auto box = truth.boxes.find(frame);
  if (box == truth.boxes.end() || !box->second) return {};
  const auto polygon = truth.polygons.find(frame);
  return polygon != truth.polygons.end() ? polygon->second : cornersOf(*box->second);
}

/// The shape of the object in a frame; empty if the truth does not know it. Where there are parts a
/// box does not stand for them: its corners are other points.
std::vector<cv::Point2d> shapeAt(int frame, const GroundTruth& truth) {
  const std::size_t count = partCount(truth);
  return count > 0 ? partsAt(frame, count, truth) : boxAt(frame, truth);
}

/// With all parts, all of them seen where there is such a frame: where one is hidden it may have
/// been guessed, or be no place at all.
std::optional<int> firstFrameWithParts(const GroundTruth& truth, std::size_t count) {
  std::optional<int> first;
  for (const auto& [frame, points] : truth.points) {
    if (points.size() != count) continue;
    const bool are_seen = std::all_of(points.begin(), points.end(),
                                      [](const auto& entry) { return entry.second.visible; });
    if (are_seen) return frame;
    if (!first) first = frame;
  }
  return first;
}

std::optional<int> firstKnownFrame(const GroundTruth& truth) {
  const std::size_t count = partCount(truth);
  if (count > 0) return firstFrameWithParts(truth, count);
  for (const auto& [frame, box] : truth.boxes) {
    if (box) return frame;
  }
  return std::nullopt;
}

std::string neededIn(const GroundTruth& truth) {
  const std::size_t count = partCount(truth);
  return count > 0 ? "a frame with all the " + std::to_string(count) + " parts of the ground truth"
                   : "a frame with a box of the ground truth";
}

}  // namespace

void readBoxes(const std::string& path, GroundTruth& truth) {
  std::ifstream file = openText(path);
  std::string line;
  int frame = 0;
  int blank = 0;  // number of the first blank line, which may be the last one of the file only
  for (int number = 1; std::getline(file, line); ++number) {
    if (isBlank(line)) {
      if (blank == 0) blank = number;
      continue;
    }
    if (blank > 0) {
      refuse(path, blank, "is blank, write NaN,NaN,NaN,NaN where there is no object");
    }
    const std::vector<double> n = numbersIn(line, path, number);
    if (n.size() != 4 && n.size() != 8) {
      refuse(
          path, number,
          "has " + std::to_string(n.size()) + " numbers, must be x,y,w,h or the 8 of four corners");
    }
    refuseInfinite(n, line, path, number);
    std::optional<cv::Rect2d> box;
    if (!hasNan(n)) {
      box = n.size() == 4 ? cv::Rect2d(n[0], n[1], n[2], n[3]) : uprightBounds(cornersIn(n));
      if (!(box->width > 0.0 && box->height > 0.0)) box.reset();
    }
    if (box && n.size() == 8) {
      const auto entry = truth.polygons.insert_or_assign(frame, cornersIn(n)).first;
      truth.boxes_turn = truth.boxes_turn || !isUpright(entry->second);
    }
    truth.boxes[frame++] = box;
  }
}

void readPoints(const std::string& path, GroundTruth& truth) {
  std::ifstream file = openText(path);
  std::string line;
  const std::string header = "frame,part,x,y,visible";
  if (!std::getline(file, line) || line.compare(0, header.size(), header) != 0) {
    refuse(path, 1, "is '" + line + "', must be the header " + header);
  }
  for (int number = 2; std::getline(file, line); ++number) {
    if (isBlank(line)) continue;
    const std::vector<double> n = numbersIn(line, path, number);
    if (n.size() != 5) {
      refuse(path, number, "has " + std::to_string(n.size()) + " numbers, must have 5: " + header);
    }
    const int frame = indexFrom(n[0], "frame", path, number);
    const int part = indexFrom(n[1], "part", path, number);
    refuseInfinite(n, line, path, number);
    if (!hasNan(n)) truth.points[frame][part] = {{n[2], n[3]}, n[4] != 0.0};
  }
}

std::size_t partCount(const GroundTruth& truth) {
  std::size_t count = 0;
  for (const auto& [frame, points] : truth.points) {
    if (!points.empty()) count = std::max(count, std::size_t(points.rbegin()->first) + 1);
  }
  return count;
}

GroundTruth readGroundTruth(const std::string& folder) {
  GroundTruth truth;
  const std::string boxes = (fs::path(folder) / "groundtruth_rect.txt").string();
  const std::string points = (fs::path(folder) / "groundtruth_parts.csv").string();
  if (fs::exists(boxes)) readBoxes(boxes, truth);
  if (fs::exists(points)) readPoints(points, truth);
  return truth;
}

std::optional<SequenceStart> readStart(const std::string& folder, const GroundTruth& truth) {
  const std::string path = (fs::path(folder) / "init.yaml").string();
  Init init;
  if (!folder.empty() && fs::exists(path)) init = readInit(path);
  SequenceStart& start = init.start;
  if (!start.points.empty()) return start;
  if (truth.empty()) return std::nullopt;
  if (init.first_frame_line == 0) {
    const std::optional<int> first = firstKnownFrame(truth);
    if (!first) return std::nullopt;
    start.first_frame = *first;
  }
  start.points = shapeAt(start.first_frame, truth);
  if (!start.points.empty()) return start;
  refuse(path, init.first_frame_line,
         "first_frame is " + std::to_string(start.first_frame) + ", must be " + neededIn(truth));
}

}  // namespace chain_tracker
