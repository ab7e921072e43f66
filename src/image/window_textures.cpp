// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/window_textures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <opencv2/imgproc.hpp>

#include "chain_tracker/image/multiversion.h"
#include "reused_plane.h"

namespace chain_tracker {
namespace {

/// The window's quadrants without the middle row and column of an odd window: left minus right,
/// upper minus lower, and diagonal minus diagonal.
haar::FeatureEnsemble quadrantFeatures(int window_cells) {
  const int half = window_cells / 2;
  const int far = window_cells - half;
  const auto feature = [&](const std::string& name, int ur, int ll, int lr) {
    return haar::HaarFeature{name,
                             {{0, 0, half, half, 1},
                              {far, 0, half, half, ur},
                              {0, far, half, half, ll},
                              {far, far, half, half, lr}}};
  };
  return {"quadrants",
          {feature("left_right", -1, 1, -1), feature("up_down", 1, -1, -1),
           feature("diagonal", -1, -1, 1)}};
}

/// Features of a row of windows, and what their norms make of them.
struct TextureRow {
  const int* features[kTextureSize];
  float* textures[kTextureSize];
};

CHAIN_TRACKER_MULTIVERSION
void normalize(const TextureRow& row, float quadrant_cells, int columns) {
  const int* __restrict left_right = row.features[0];
  const int* __restrict up_down = row.features[1];
  const int* __restrict diagonal = row.features[2];
  float* __restrict left_right_out = row.textures[0];
  float* __restrict up_down_out = row.textures[1];
  float* __restrict diagonal_out = row.textures[2];
  const float scale = 0.5F / quadrant_cells;
  const float flat = kFlatContrast * kFlatContrast;
  for (int x = 0; x < columns; ++x) {
    const float a = scale * static_cast<float>(left_right[x]);
    const float b = scale * static_cast<float>(up_down[x]);
    const float c = scale * static_cast<float>(diagonal[x]);
    const float norm = 1.0F / std::sqrt(a * a + b * b + c * c + flat);
    left_right_out[x] = a * norm;
    up_down_out[x] = b * norm;
    diagonal_out[x] = c * norm;
  }
}

}  // namespace

WindowTexturesWorkspace::WindowTexturesWorkspace() : features(quadrantFeatures) {}

WindowTexture textureOf(float upper_left, float upper_right, float lower_left, float lower_right) {
  const float a = 0.5F * (upper_left + lower_left - upper_right - lower_right);
  const float b = 0.5F * (upper_left + upper_right - lower_left - lower_right);
  const float c = 0.5F * (upper_left + lower_right - upper_right - lower_left);
  const float norm = std::sqrt(a * a + b * b + c * c + kFlatContrast * kFlatContrast);
  return {a / norm, b / norm, c / norm};
}

void computeWindowTextures(FramePixels& pixels, const WindowLattice& lattice,
                           std::array<cv::Mat1f, kTextureSize>& textures,
                           WindowTexturesWorkspace& workspace) {
  for (cv::Mat1f& plane : textures) reuse(plane, lattice.size);
  if (lattice.window_cells == 1) {
    for (cv::Mat1f& plane : textures) plane.setTo(0.0F);
    return;
  }
  const cv::Rect region = lattice.pixels();
  reuse(workspace.cells, region.size() / lattice.step);
  cv::resize(pixels.grey(region), workspace.cells, workspace.cells.size(), 0.0, 0.0,
             cv::INTER_AREA);
  const std::vector<cv::Mat1i>& features = workspace.features.compute(
      workspace.cells, lattice.window_cells, std::numeric_limits<uchar>::max());
  const auto quadrant_cells =
      static_cast<float>((lattice.window_cells / 2) * (lattice.window_cells / 2));
  for (int row = 0; row < lattice.size.height; ++row) {
    TextureRow windows{};
    for (size_t i = 0; i < kTextureSize; ++i) {
      windows.features[i] = features[i][row];
      windows.textures[i] = textures[i][row];
    }
    normalize(windows, quadrant_cells, lattice.size.width);
  }
}

}  // namespace chain_tracker
