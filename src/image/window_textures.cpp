// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/window_textures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <opencv2/imgproc.hpp>

#include "chain_tracker/image/multiversion.h"
#include "reused_plane.h"

namespace chain_tracker {
namespace {

/// Sums over the quadrants of a row of windows, and where their textures go.
struct TextureRow {
  const int* upper_left;
  const int* upper_right;
  const int* lower_left;
  const int* lower_right;
  float* left_right;
  float* up_down;
  float* diagonal;
};

CHAIN_TRACKER_MULTIVERSION
void computeRow(const TextureRow& row, float quadrant_cells, int columns) {
  const int* __restrict ul = row.upper_left;
  const int* __restrict ur = row.upper_right;
  const int* __restrict ll = row.lower_left;
  const int* __restrict lr = row.lower_right;
  float* __restrict left_right = row.left_right;
  float* __restrict up_down = row.up_down;
  float* __restrict diagonal = row.diagonal;
  const float scale = 0.5F / quadrant_cells;
  const float flat = kFlatContrast * kFlatContrast;
  for (int x = 0; x < columns; ++x) {
    const int falling = ul[x] - lr[x];
    const int rising = ur[x] - ll[x];
    const float a = scale * static_cast<float>(falling - rising);
    const float b = scale * static_cast<float>(falling + rising);
    const float c = scale * static_cast<float>(ul[x] + lr[x] - ur[x] - ll[x]);
    const float norm = 1.0F / std::sqrt(a * a + b * b + c * c + flat);
    left_right[x] = a * norm;
    up_down[x] = b * norm;
    diagonal[x] = c * norm;
  }
}

}  // namespace

WindowTexture textureOf(float upper_left, float upper_right, float lower_left, float lower_right) {
  const float a = 0.5F * (upper_left + lower_left - upper_right - lower_right);
  const float b = 0.5F * (upper_left + upper_right - lower_left - lower_right);
  const float c = 0.5F * (upper_left + lower_right - upper_right - lower_left);
  const float norm = std::sqrt(a * a + b * b + c * c + kFlatContrast * kFlatContrast);
  return {a / norm, b / norm, c / norm};
}

double strengthOf(const WindowTexture& texture) {
  return std::sqrt(std::inner_product(texture.begin(), texture.end(), texture.begin(), 0.0));
}

void computeWindowTextures(FramePixels& pixels, const WindowLattice& lattice,
                           std::array<cv::Mat1f, kTextureSize>& textures,
                           WindowTexturesWorkspace& workspace) {
  for (cv::Mat1f& plane : textures) reuse(plane, lattice.size);
  if (lattice.window_cells == 1) {
    for (cv::Mat1f& plane : textures) fill(plane, 0.0F);
    return;
  }
  const cv::Rect region = lattice.pixels();
  reuse(workspace.cells, region.size() / lattice.step);
  cv::resize(pixels.grey(region), workspace.cells, workspace.cells.size(), 0.0, 0.0,
             cv::INTER_AREA);
  // The middle row and column of an odd window are in no quadrant.
  const int half = lattice.window_cells / 2;
  const int far = lattice.window_cells - half;
  const cv::Mat1i& sums =
      workspace.quadrants.compute(workspace.cells, half, std::numeric_limits<uchar>::max());
  for (int row = 0; row < lattice.size.height; ++row) {
    const int* upper = sums[row];
    const int* lower = sums[row + far];
    computeRow({upper, upper + far, lower, lower + far, textures[0][row], textures[1][row],
                textures[2][row]},
               static_cast<float>(half * half), lattice.size.width);
  }
}

}  // namespace chain_tracker
