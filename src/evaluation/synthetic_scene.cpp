// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/evaluation/synthetic_scene.h"

#include <stdexcept>

#include "composed_scene.h"
#include "scene_backgrounds.h"

namespace chain_tracker {
namespace {

const std::vector<SceneRecipe>& recipes() {
  static const std::vector<SceneRecipe> kAll{
      {"bottle", "bottle", paintWall, makeBottle},
      {"box", "box", paintDesk, makeBox},
      {"robot_arm", "robot_arm", paintWorkshop, makeRobotArm},
      {"finger_pair", "finger_pair", paintBookcase, makeFingerPair},
      {"cable", "cable", paintDesk, makeCable},
      {"suture", "suture", paintTissue, makeSuture},
      {"guitar_string", "guitar_string", paintDimRoom, makeGuitarString},
      {"lips", "lips", paintDimRoom, makeLips},
      {"plastic_bag", "plastic_bag", paintStreet, makePlasticBag},
  };
  return kAll;
}

std::string joined(const std::vector<std::string>& texts, const std::string& separator) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : separator) + text;
  return all;
}

}  // namespace

std::vector<std::string> sceneNames() {
  std::vector<std::string> names;
  for (const SceneRecipe& recipe : recipes()) names.push_back(recipe.name);
  return names;
}

std::unique_ptr<SyntheticScene> makeScene(const std::string& name, const SceneOptions& options) {
  const std::vector<std::string> faults = sceneOptionFaults(options);
  if (!faults.empty()) throw std::invalid_argument(joined(faults, "; "));
  for (const SceneRecipe& recipe : recipes()) {
    if (recipe.name == name) return std::make_unique<ComposedScene>(recipe, options);
  }
  throw std::invalid_argument("scene is '" + name +
                              "', must be one of: " + joined(sceneNames(), ", "));
}

}  // namespace chain_tracker
