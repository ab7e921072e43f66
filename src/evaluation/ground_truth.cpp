// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/evaluation/ground_truth.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

#include <yaml-cpp/yaml.h>

#include "chain_tracker/image/pixel_geometry.h"

namespace chain_tracker {
namespace {

namespace fs = std::filesystem;

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

std::vector<cv::Point2d> pointsIn(const YAML::Node& node, const std::string& path) {
  std::vector<cv::Point2d> points;
  for (const YAML::Node& point : node) {
    if (!point.IsSequence() || point.size() != 2) {
      refuse(path, point.Mark().line + 1, "a point must be [x, y]");
    }
    points.emplace_back(point[0].as<double>(), point[1].as<double>());
  }
  return points;
}

SequenceStart readInit(const std::string& path) {
  SequenceStart start;
  try {
    const YAML::Node document = YAML::LoadFile(path);
    for (const auto& entry : document) {
      const std::string key = entry.first.as<std::string>();
      if (key == "model") {
        start.model = entry.second.as<std::string>();
      } else if (key == "first_frame") {
        start.first_frame = entry.second.as<int>();
        if (start.first_frame < 0) {
          refuse(path, entry.second.Mark().line + 1,
                 "first_frame is " + std::to_string(start.first_frame) + ", must be at least 0");
        }
      } else if (key == "points") {
        start.points = pointsIn(entry.second, path);
      } else {
        refuse(path, entry.first.Mark().line + 1,
               "unknown key '" + key + "', must be one of: first_frame, model, points");
      }
    }
  } catch (const YAML::Exception& error) {
    refuse(path, error.mark.line + 1, error.msg);
  }
  return start;
}

}  // namespace

void readBoxes(const std::string& path, GroundTruth& truth) {
  std::ifstream file = openText(path);
  std::string line;
  int frame = 0;
  for (int number = 1; std::getline(file, line); ++number) {
    if (isBlank(line)) continue;
    const std::vector<double> n = numbersIn(line, path, number);
    if (n.size() != 4 && n.size() != 8) {
      refuse(
          path, number,
          "has " + std::to_string(n.size()) + " numbers, must be x,y,w,h or the 8 of four corners");
    }
    std::optional<cv::Rect2d> box;
    if (!hasNan(n)) {
      box = n.size() == 4 ? cv::Rect2d(n[0], n[1], n[2], n[3]) : uprightBounds(cornersIn(n));
      if (!(box->width > 0.0 && box->height > 0.0)) box.reset();
    }
    if (frame == 0 && box && n.size() == 8) truth.first_polygon = cornersIn(n);
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
    if (!hasNan(n)) truth.points[frame][part] = {{n[2], n[3]}, n[4] != 0.0};
  }
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
  const fs::path init = fs::path(folder) / "init.yaml";
  SequenceStart start;
  if (fs::exists(init)) start = readInit(init.string());
  if (!start.points.empty()) return start;
  if (!truth.points.empty()) {
    start.first_frame = truth.points.begin()->first;
    for (const auto& point : truth.points.begin()->second) {
      start.points.push_back(point.second.position);
    }
    return start;
  }
  for (const auto& [frame, box] : truth.boxes) {
    if (!box) continue;
    start.first_frame = frame;
    start.points =
        frame == 0 && !truth.first_polygon.empty() ? truth.first_polygon : cornersOf(*box);
    return start;
  }
  return std::nullopt;
}

}  // namespace chain_tracker
