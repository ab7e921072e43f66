// SPDX-License-Identifier: BSD-3-Clause
/// How badly a part's learned pattern of brightness matches the window around each candidate
/// position: the second appearance channel, where colours alone do not tell.
#pragma once

#include <array>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/part_costs.h"
#include "chain_tracker/image/window_textures.h"

namespace chain_tracker {

struct TextureCostsWorkspace {
  std::array<cv::Mat1f, kTextureSize> textures;
  WindowTexturesWorkspace windows;
};

/// costs[k](row, column) += weight / 2 * |texture of part k - texture of the window at that state|,
/// in [0, weight]. O(pixels of the lattice + parts x states).
void addTextureCosts(FramePixels& pixels, const std::vector<WindowTexture>& parts,
                     const CandidateGrid& grid, double weight, std::vector<cv::Mat1f>& costs,
                     TextureCostsWorkspace& workspace);

}  // namespace chain_tracker
