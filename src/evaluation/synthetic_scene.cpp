// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/evaluation/synthetic_scene.h"

#include <sstream>
#include <stdexcept>

#include "bottle_scene.h"

namespace chain_tracker {
namespace {

template <typename Value>
void require(bool good, const std::string& option, const Value& value, const std::string& allowed) {
  if (good) return;
  std::ostringstream message;
  message << "scene option " << option << " is " << value << ", must be " << allowed;
  throw std::invalid_argument(message.str());
}

}  // namespace

std::vector<std::string> sceneNames() { return {"bottle"}; }

std::unique_ptr<SyntheticScene> makeScene(const std::string& name, const SceneOptions& options) {
  require(options.frames >= 1, "frames", options.frames, "at least 1");
  require(options.size.width >= 64 && options.size.height >= 64, "size", options.size,
          "at least 64 x 64");
  require(options.noise >= 0.0, "noise", options.noise, "at least 0");
  if (name == "bottle") return std::make_unique<BottleScene>(options);
  std::string names;
  for (const std::string& known : sceneNames()) names += (names.empty() ? "" : ", ") + known;
  throw std::invalid_argument("scene is '" + name + "', must be one of: " + names);
}

}  // namespace chain_tracker
