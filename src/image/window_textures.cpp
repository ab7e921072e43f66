// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/window_textures.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "chain_tracker/image/multiversion.h"

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

/// Rows of the integral image at the corners of the quadrants.
struct CornerRows {
  const int* top;
  const int* upper_middle;
  const int* lower_middle;
  const int* bottom;
};

CHAIN_TRACKER_MULTIVERSION
void textureRow(const CornerRows& corners, int step, int half, int side, int columns,
                float* __restrict left_right, float* __restrict up_down,
                float* __restrict diagonal) {
  const int* __restrict top = corners.top;
  const int* __restrict upper = corners.upper_middle;
  const int* __restrict lower = corners.lower_middle;
  const int* __restrict bottom = corners.bottom;
  const int right = side - half;
  const float scale = 0.5F / (static_cast<float>(half) * static_cast<float>(half));
  const float flat = kFlatContrast * kFlatContrast;
  for (int column = 0; column < columns; ++column) {
    const int x = column * step;
    const int ul = upper[x + half] - upper[x] - top[x + half] + top[x];
    const int ur = upper[x + side] - upper[x + right] - top[x + side] + top[x + right];
    const int ll = bottom[x + half] - bottom[x] - lower[x + half] + lower[x];
    const int lr = bottom[x + side] - bottom[x + right] - lower[x + side] + lower[x + right];
    const float a = scale * static_cast<float>(ul + ll - ur - lr);
    const float b = scale * static_cast<float>(ul + ur - ll - lr);
    const float c = scale * static_cast<float>(ul + lr - ur - ll);
    const float norm = 1.0F / std::sqrt(a * a + b * b + c * c + flat);
    left_right[column] = a * norm;
    up_down[column] = b * norm;
    diagonal[column] = c * norm;
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

void computeWindowTextures(const cv::Mat& image, const WindowLattice& lattice,
                           std::array<cv::Mat1f, kTextureSize>& textures,
                           WindowTexturesWorkspace& workspace) {
  for (cv::Mat1f& plane : textures) plane.create(lattice.size);
  const int half = (lattice.window_cells / 2) * lattice.step;
  const int side = lattice.window_cells * lattice.step;
  if (half == 0) {
    for (cv::Mat1f& plane : textures) plane.setTo(0.0F);
    return;
  }
  greyPixels(image, lattice.pixels(), workspace);
  cv::integral(workspace.pixels, workspace.integral, CV_32S);
  for (int row = 0; row < lattice.size.height; ++row) {
    const int y = row * lattice.step;
    const CornerRows corners{workspace.integral[y], workspace.integral[y + half],
                             workspace.integral[y + side - half], workspace.integral[y + side]};
    textureRow(corners, lattice.step, half, side, lattice.size.width, textures[0][row],
               textures[1][row], textures[2][row]);
  }
}

}  // namespace chain_tracker
