// SPDX-License-Identifier: BSD-3-Clause
/// The pattern of brightness in square windows on a lattice of positions: the three basic Haar-like
/// features over the whole window, relative to its contrast (thesis ch. 5; Viola and Jones 2001).
///
/// With the means of the window's quadrants, columns left and right, rows upper and lower:
///   left_right = (ul + ll - ur - lr) / 2,  up_down = (ul + ur - ll - lr) / 2,
///   diagonal = (ul + lr - ur - ll) / 2,    texture = (left_right, up_down, diagonal) / norm,
///   norm^2 = left_right^2 + up_down^2 + diagonal^2 + kFlatContrast^2.
/// So a window without a pattern has the null vector, one of high contrast a unit vector, and
/// brightness and contrast of the light drop out.
#pragma once

#include <array>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/image/window_histograms.h"

namespace chain_tracker {

/// Differences of this size are as much noise as pattern [grey levels].
constexpr float kFlatContrast = 6.0F;
constexpr size_t kTextureSize = 3;

/// left_right, up_down, diagonal.
using WindowTexture = std::array<float, kTextureSize>;

/// From the means of the quadrants [grey levels].
WindowTexture textureOf(float upper_left, float upper_right, float lower_left, float lower_right);

/// Length of the vector, in [0, 1): how much of a pattern the window has.
double strengthOf(const WindowTexture& texture);

struct WindowTexturesWorkspace {
  cv::Mat1b cells;  ///< means of grey levels
  WindowSums quadrants;
};

/// textures[i](row, column) = element i of the window's texture. A quadrant has half of the
/// window's cells in each direction; an odd window's middle row and column count for neither.
/// Outside the image its border pixels go on. The quadrants' sums are those of the Haar front end
/// on the cells, whose means are rounded to whole grey levels; the features, which share them, are
/// never stored.
/// O(pixels + windows). Windows of one cell have no quadrants: their texture is null.
void computeWindowTextures(FramePixels& pixels, const WindowLattice& lattice,
                           std::array<cv::Mat1f, kTextureSize>& textures,
                           WindowTexturesWorkspace& workspace);

}  // namespace chain_tracker
