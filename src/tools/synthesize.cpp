// SPDX-License-Identifier: BSD-3-Clause
/// Renders a scene with exact ground truth as a sequence folder or a bag.
#include <iostream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include <CLI/CLI.hpp>

#include "chain_tracker/evaluation/scene_folder.h"
#include "chain_tracker/evaluation/synthetic_scene.h"
#include "common/scene_bag.h"

namespace {

using chain_tracker::SceneBurst;
using chain_tracker::SceneOptions;
using BurstArguments = std::vector<std::tuple<int, int, double>>;

/// Options as the command line gives them, before they become SceneOptions.
struct Arguments {
  std::string scene = "bottle";
  std::string out;
  std::string bag;
  SceneOptions options;
  BurstArguments shift_bursts;
  BurstArguments rotation_bursts;
};

std::vector<SceneBurst> toBursts(const BurstArguments& arguments) {
  std::vector<SceneBurst> bursts;
  for (const auto& [start, length, rate] : arguments) bursts.push_back({start, length, rate});
  return bursts;
}

void addMotionOptions(CLI::App& app, Arguments& arguments) {
  SceneOptions& options = arguments.options;
  app.add_option("--speed", options.speed, "Of shifting and bending, times the usual")
      ->capture_default_str();
  app.add_option("--rotation", options.rotation, "Fastest turn [rad/frame]")->capture_default_str();
  app.add_option("--scale-range", options.scale_range, "Largest over mean size")
      ->capture_default_str();
  app.add_option("--shift-burst", arguments.shift_bursts,
                 "START LENGTH RATE: shift by RATE px/frame and do nothing else; may be repeated");
  app.add_option("--rotation-burst", arguments.rotation_bursts,
                 "START LENGTH RATE: turn by RATE rad/frame and do nothing else; may be repeated");
  CLI::Option* const at =
      app.add_option("--leave-at", options.leave_at, "Frame by which the object is out of view");
  app.add_option("--leave-for", options.leave_for, "Frames that it stays out of view at least")
      ->needs(at);
  at->needs("--leave-for");
}

void addCameraOptions(CLI::App& app, SceneOptions& options) {
  app.add_option("--width", options.size.width, "Of the image [px]")->capture_default_str();
  app.add_option("--height", options.size.height, "Of the image [px]")->capture_default_str();
  app.add_option("--blur", options.blur,
                 "Share of the time that the shutter is open; default: the scene's own");
  app.add_option("--noise", options.noise, "Sensor noise, standard deviation in grey levels")
      ->capture_default_str();
  app.add_option("--illumination", options.illumination, "Largest relative change of the light")
      ->capture_default_str();
  app.add_flag("--grey", options.grey, "A mono camera");
}

void addStageOptions(CLI::App& app, SceneOptions& options) {
  app.add_option("--clutter", options.clutter,
                 "Number of things in the object's colours; default: the scene's own");
  app.add_option("--shadow", options.shadow,
                 "Darkness of the object's shadow, 0 to 1; default: the scene's own");
  app.add_option("--background-speed", options.background_speed,
                 "Fastest shift of the background [px/frame]")
      ->capture_default_str();
  app.add_flag("--plain", options.plain, "No bands, print or label on the object");
  app.add_option("--occlusions", options.occlusions, "How often something passes over the object")
      ->capture_default_str();
  app.add_option("--occlusion-frames", options.occlusion_frames,
                 "Frames that each covers the object's middle")
      ->capture_default_str();
  app.add_option("--occluder-size", options.occluder_size, "Of what passes, of the object's length")
      ->capture_default_str();
}

void addOptions(CLI::App& app, Arguments& arguments) {
  app.add_option("--scene", arguments.scene, "What is rendered")
      ->check(CLI::IsMember(chain_tracker::sceneNames()))
      ->capture_default_str();
  app.add_option("--seed", arguments.options.seed, "Of texture, background and motion")
      ->capture_default_str();
  app.add_option("--frames", arguments.options.frames, "Number of frames")->capture_default_str();
  CLI::Option_group* output = app.add_option_group("output");
  output->add_option("--out", arguments.out,
                     "Sequence folder to write; pictures of a longer scene in it are removed");
  output->add_option("--bag", arguments.bag,
                     std::string("Bag to write: ") + chain_tracker::kSceneImageTopic +
                         " and the truth on " + chain_tracker::kSceneTruthTopic);
  output->require_option(1, 2);
  addMotionOptions(app, arguments);
  addCameraOptions(app, arguments.options);
  addStageOptions(app, arguments.options);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Renders a scene with exact ground truth as a sequence folder, a bag or both.");
  Arguments arguments;
  addOptions(app, arguments);
  try {
    app.parse(argc, argv);
    SceneOptions& options = arguments.options;
    options.shift_bursts = toBursts(arguments.shift_bursts);
    options.rotation_bursts = toBursts(arguments.rotation_bursts);
    const auto scene = chain_tracker::makeScene(arguments.scene, options);
    if (!arguments.out.empty()) {
      chain_tracker::writeSceneFolder(*scene, options, arguments.out);
    }
    if (!arguments.bag.empty()) chain_tracker::writeSceneBag(*scene, options, arguments.bag);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::cerr << "synthesize: " << error.what() << "\n";
    return 2;
  }
  return 0;
}
