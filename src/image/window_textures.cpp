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

/// Grey pixels of a region that may reach outside the image.
void greyPixels(const cv::Mat& image, const cv::Rect& region, WindowTexturesWorkspace& workspace) {
  // The image's pixels nearest to the region: at least one, whose copies stand for the outside.
  const auto column = [&](int x) { return std::clamp(x, 0, image.cols - 1); };
  const auto row = [&](int y) { return std::clamp(y, 0, image.rows - 1); };
  const cv::Point first(column(region.x), row(region.y));
  const cv::Point last(column(region.br().x - 1), row(region.br().y - 1));
  const cv::Rect inside(first, last + cv::Point(1, 1));
  if (image.channels() == 3) {
    cv::cvtColor(image(inside), workspace.grey, cv::COLOR_BGR2GRAY);
  } else {
    image(inside).copyTo(workspace.grey);
  }
  const cv::Rect whole = region | inside;
  cv::copyMakeBorder(workspace.grey, workspace.pixels, inside.y - whole.y,
                     whole.br().y - inside.br().y, inside.x - whole.x, whole.br().x - inside.br().x,
                     cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  workspace.pixels = workspace.pixels(region - whole.tl());
}

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

/// Sums of the pixels of each cell.
void sumCells(const cv::Mat1b& pixels, int step, CellPlane& cells) {
  reuse(cells, {pixels.cols / step, pixels.rows / step});
  cells.setTo(0);
  for (int y = 0; y < cells.rows * step; ++y) {
    const uchar* pixel = pixels[y];
    int* const cell = cells[y / step];
    for (int column = 0; column < cells.cols; ++column) {
      for (int i = 0; i < step; ++i) cell[column] += *pixel++;
    }
  }
}

/// Features of a row of windows, and what their norms make of them.
struct TextureRow {
  const int* features[kTextureSize];
  float* textures[kTextureSize];
};

CHAIN_TRACKER_MULTIVERSION
void normalize(const TextureRow& row, float quadrant_area, int columns) {
  const int* __restrict left_right = row.features[0];
  const int* __restrict up_down = row.features[1];
  const int* __restrict diagonal = row.features[2];
  float* __restrict left_right_out = row.textures[0];
  float* __restrict up_down_out = row.textures[1];
  float* __restrict diagonal_out = row.textures[2];
  const float scale = 0.5F / quadrant_area;
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

WindowTexturesWorkspace::WindowTexturesWorkspace() : cells(1), features(quadrantFeatures) {}

WindowTexture textureOf(float upper_left, float upper_right, float lower_left, float lower_right) {
  const float a = 0.5F * (upper_left + lower_left - upper_right - lower_right);
  const float b = 0.5F * (upper_left + upper_right - lower_left - lower_right);
  const float c = 0.5F * (upper_left + lower_right - upper_right - lower_left);
  const float norm = std::sqrt(a * a + b * b + c * c + kFlatContrast * kFlatContrast);
  return {a / norm, b / norm, c / norm};
}

void computeWindowTextures(const cv::Mat& image, const WindowLattice& lattice,
                           std::array<cv::Mat1f, kTextureSize>& textures,
                           WindowTexturesWorkspace& workspace) {
  for (cv::Mat1f& plane : textures) reuse(plane, lattice.size);
  const int half = (lattice.window_cells / 2) * lattice.step;
  if (half == 0) {
    for (cv::Mat1f& plane : textures) plane.setTo(0.0F);
    return;
  }
  greyPixels(image, lattice.pixels(), workspace);
  sumCells(workspace.pixels, lattice.step, workspace.cells.front());
  const int max_cell = std::numeric_limits<uchar>::max() * lattice.step * lattice.step;
  const std::vector<cv::Mat1i>& features =
      workspace.features.compute(workspace.cells, 1, lattice.window_cells, max_cell);
  const float quadrant_area = static_cast<float>(half) * static_cast<float>(half);
  for (int row = 0; row < lattice.size.height; ++row) {
    TextureRow windows{};
    for (size_t i = 0; i < kTextureSize; ++i) {
      windows.features[i] = features[i][row];
      windows.textures[i] = textures[i][row];
    }
    normalize(windows, quadrant_area, lattice.size.width);
  }
}

}  // namespace chain_tracker
