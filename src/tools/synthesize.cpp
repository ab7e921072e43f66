// SPDX-License-Identifier: BSD-3-Clause
/// Renders a scene with exact ground truth as a sequence folder.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>
#include <opencv2/imgcodecs.hpp>

#include "chain_tracker/evaluation/synthetic_scene.h"

namespace {

namespace fs = std::filesystem;

std::ofstream openForWriting(const fs::path& path) {
  std::ofstream file(path);
  if (!file) throw std::runtime_error(path.string() + " cannot be written");
  file << std::fixed;
  file.precision(3);
  return file;
}

void writeInit(const fs::path& path, const std::string& model,
               const std::vector<cv::Point2d>& points) {
  std::ofstream file = openForWriting(path);
  file << "model: " << model << "\npoints: [";
  for (size_t i = 0; i < points.size(); ++i) {
    file << (i > 0 ? ", " : "") << "[" << points[i].x << ", " << points[i].y << "]";
  }
  file << "]\nfirst_frame: 0\n";
}

void writeSequence(const chain_tracker::SyntheticScene& scene, int frames, const fs::path& out) {
  fs::create_directories(out / "img");
  std::ofstream truth = openForWriting(out / "groundtruth_parts.csv");
  truth << "frame,part,x,y,visible\n";
  for (int index = 0; index < frames; ++index) {
    const chain_tracker::SceneFrame frame = scene.render(index);
    if (index == 0) writeInit(out / "init.yaml", scene.model(), frame.points);
    const std::string name = cv::format("%06d.png", index);
    if (!cv::imwrite((out / "img" / name).string(), frame.image)) {
      throw std::runtime_error((out / "img" / name).string() + " cannot be written");
    }
    for (size_t part = 0; part < frame.points.size(); ++part) {
      truth << index << "," << part << "," << frame.points[part].x << "," << frame.points[part].y
            << ",1\n";
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Renders a scene with exact ground truth as a sequence folder.");
  std::string scene = "bottle";
  std::string out;
  chain_tracker::SceneOptions options;
  app.add_option("--scene", scene, "What is rendered")
      ->check(CLI::IsMember(chain_tracker::sceneNames()))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "Of texture, background and motion")
      ->capture_default_str();
  app.add_option("--frames", options.frames, "Number of frames")->capture_default_str();
  app.add_option("--noise", options.noise, "Sensor noise, standard deviation in grey levels")
      ->capture_default_str();
  app.add_option("--out", out, "Folder to write")->required();
  try {
    app.parse(argc, argv);
    writeSequence(*chain_tracker::makeScene(scene, options), options.frames, out);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::cerr << "synthesize: " << error.what() << "\n";
    return 2;
  }
  return 0;
}
