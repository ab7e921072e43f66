// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/texture_costs.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/lattice_candidates.h"
#include "support/random_inputs.h"

namespace chain_tracker {
namespace {

/// Textures do not look at colours.
ColorPalette onlyPalette(const cv::Mat& image) {
  return {image, cv::Mat1b(image.size(), uchar(255)), cv::Mat1b(image.size(), uchar(0)), {2, 0.0}};
}

TEST(AddTextureCosts, addHalfTheWeightedDistance) {
  RandomInputs random(1);
  const cv::Mat image = random.noise({90, 70}, CV_8UC3);
  const ColorPalette palette = onlyPalette(image);
  FramePixels pixels(palette, image);
  const std::vector<WindowTexture> parts = {{0.5F, -0.3F, 0.1F}, {0.0F, 0.0F, 0.0F}};
  struct Case {
    cv::Point2d second;
    int step;
    bool is_sparse;
  };
  for (const Case& each : {Case{{52, 41}, 1, true}, {{52, 41}, 2, true}, {{33, 31}, 1, false}}) {
    const CandidateGrid grid = gridAround({{30, 30}, each.second}, 12.0, each.step, 6.0);
    ASSERT_EQ(grid.isSparse(), each.is_sparse);
    const double weight = 3.0;
    std::vector<cv::Mat1f> costs = random.costMaps(2, grid.states);
    std::vector<cv::Mat1f> before = {costs[0].clone(), costs[1].clone()};
    TextureCostsWorkspace workspace;
    addTextureCosts(pixels, parts, grid, weight, costs, workspace);
    std::array<cv::Mat1f, kTextureSize> textures;
    WindowTexturesWorkspace windows;
    computeWindowTextures(pixels, grid.lattice, textures, windows);
    for (size_t k = 0; k < parts.size(); ++k) {
      for (int row = 0; row < grid.states.height; ++row) {
        for (int column = 0; column < grid.states.width; ++column) {
          double square = 0.0;
          for (size_t i = 0; i < kTextureSize; ++i) {
            const double difference =
                textures[i](grid.corners[k].y + row, grid.corners[k].x + column) - parts[k][i];
            square += difference * difference;
          }
          ASSERT_NEAR(before[k](row, column) + 0.5 * weight * std::sqrt(square),
                      costs[k](row, column), 1e-4);
        }
      }
    }
  }
}

TEST(AddTextureCosts, areNothingAtTheWeightNought) {
  RandomInputs random(2);
  const cv::Mat image = random.noise({90, 70}, CV_8UC1);
  const ColorPalette palette = onlyPalette(image);
  FramePixels pixels(palette, image);
  const CandidateGrid grid = gridAround({{30, 30}}, 12.0, 2, 6.0);
  std::vector<cv::Mat1f> costs = random.costMaps(1, grid.states);
  const cv::Mat1f before = costs[0].clone();
  TextureCostsWorkspace workspace;
  addTextureCosts(pixels, {{0.5F, 0.5F, 0.0F}}, grid, 0.0, costs, workspace);
  EXPECT_EQ(0.0, cv::norm(before, costs[0], cv::NORM_INF));
}

}  // namespace
}  // namespace chain_tracker
