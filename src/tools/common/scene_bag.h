// SPDX-License-Identifier: BSD-3-Clause
/// Scenes as bags.
#pragma once

#include <string>

#include "chain_tracker/evaluation/synthetic_scene.h"

namespace chain_tracker {

/// Topics of a rendered bag.
constexpr const char* kSceneImageTopic = "/camera/image_raw";
constexpr const char* kSceneTruthTopic = "/ground_truth/objects";

/// Renders the scene's first options.frames frames into a bag, 30 a second from 1 s on: the
/// pictures (bgr8, or mono8 if options.grey) and, with the same stamps, the truth as a
/// TrackedObjectArray. The object is left out of the array while it is out of view; its outline is
/// its upright box, five corners of which the last is the first. Throws rosbag::BagException if the
/// file cannot be written, std::invalid_argument if the disk has no room for it.
void writeSceneBag(const SyntheticScene& scene, const SceneOptions& options,
                   const std::string& path);

}  // namespace chain_tracker
