// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/texture_costs.h"

#include <cmath>

#include "chain_tracker/image/multiversion.h"

namespace chain_tracker {
namespace {

CHAIN_TRACKER_MULTIVERSION
void addRow(const float* __restrict left_right, const float* __restrict up_down,
            const float* __restrict diagonal, const WindowTexture& learned, float half_weight,
            float* __restrict costs, int columns) {
  const float a = learned[0];
  const float b = learned[1];
  const float c = learned[2];
  for (int x = 0; x < columns; ++x) {
    const float da = left_right[x] - a;
    const float db = up_down[x] - b;
    const float dc = diagonal[x] - c;
    costs[x] += half_weight * std::sqrt(da * da + db * db + dc * dc);
  }
}

}  // namespace

void addTextureCosts(FramePixels& pixels, const std::vector<WindowTexture>& parts,
                     const CandidateGrid& grid, double weight, std::vector<cv::Mat1f>& costs,
                     TextureCostsWorkspace& workspace) {
  const bool is_sparse = grid.isSparse();
  if (!is_sparse) {
    computeWindowTextures(pixels, grid.lattice, workspace.textures, workspace.windows);
  }
  const auto half_weight = static_cast<float>(0.5 * weight);
  for (size_t k = 0; k < parts.size(); ++k) {
    if (is_sparse) {
      computeWindowTextures(pixels, grid.latticeOf(k), workspace.textures, workspace.windows);
    }
    const cv::Point corner = is_sparse ? cv::Point(0, 0) : grid.corners[k];
    for (int row = 0; row < grid.states.height; ++row) {
      const auto from = [&](size_t i) { return workspace.textures[i][corner.y + row] + corner.x; };
      addRow(from(0), from(1), from(2), parts[k], half_weight, costs[k][row], grid.states.width);
    }
  }
}

}  // namespace chain_tracker
