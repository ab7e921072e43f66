// SPDX-License-Identifier: BSD-3-Clause
/// Scenes as sequence folders.
#pragma once

#include <functional>
#include <string>

#include "chain_tracker/evaluation/synthetic_scene.h"

namespace chain_tracker {

/// Renders the scene's first options.frames frames into `folder`, which is made if need be:
///
/// - img/000000.png and so on; with one channel if options.grey. Those that a longer scene has left
///   in the folder are removed, other files are not
/// - groundtruth_parts.csv: `frame,part,x,y,visible`
/// - groundtruth_rect.txt: `x,y,w,h` a frame; NaN,NaN,NaN,NaN while the object is out of view
/// - groundtruth_segments.csv: `frame,segment,x,y,theta,scale`, as in SceneFrame::segments
/// - init.yaml: the model's name and the points of frame 0
///
/// `progress` is called after each frame with the number of frames done. Throws std::runtime_error
/// naming the file that cannot be written.
void writeSceneFolder(
    const SyntheticScene& scene, const SceneOptions& options, const std::string& folder,
    const std::function<void(int)>& progress = [](int) {});

}  // namespace chain_tracker
