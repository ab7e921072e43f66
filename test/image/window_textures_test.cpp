// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/window_textures.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "support/random_inputs.h"

namespace chain_tracker {
namespace {

/// Sum of the pixels of a rectangle, one by one; the image's border goes on outside it.
double sumOf(const cv::Mat& image, const cv::Rect& rectangle) {
  cv::Mat1b grey = image;
  if (image.channels() == 3) cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  double sum = 0.0;
  for (int y = rectangle.y; y < rectangle.br().y; ++y) {
    for (int x = rectangle.x; x < rectangle.br().x; ++x) {
      sum += grey(std::clamp(y, 0, grey.rows - 1), std::clamp(x, 0, grey.cols - 1));
    }
  }
  return sum;
}

/// Mean over so many cells in each direction of the cells' rounded means.
double meanOfCells(const cv::Mat& image, const cv::Point& corner, int cells, int step) {
  double sum = 0.0;
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      const cv::Rect cell(corner.x + column * step, corner.y + row * step, step, step);
      sum += std::floor(sumOf(image, cell) / cell.area() + 0.5);
    }
  }
  return sum / (cells * cells);
}

/// The definition, window by window.
WindowTexture slowTexture(const cv::Mat& image, const WindowLattice& lattice,
                          const cv::Point& window) {
  const int half = lattice.window_cells / 2;
  if (half == 0) return {0.0F, 0.0F, 0.0F};
  const int far = (lattice.window_cells - half) * lattice.step;
  const cv::Point corner = lattice.origin + window * lattice.step;
  const auto quadrant = [&](int x, int y) {
    return meanOfCells(image, corner + cv::Point(x, y), half, lattice.step);
  };
  const double ul = quadrant(0, 0);
  const double ur = quadrant(far, 0);
  const double ll = quadrant(0, far);
  const double lr = quadrant(far, far);
  const double a = (ul + ll - ur - lr) / 2.0;
  const double b = (ul + ur - ll - lr) / 2.0;
  const double c = (ul + lr - ur - ll) / 2.0;
  const double norm = std::sqrt(a * a + b * b + c * c + kFlatContrast * kFlatContrast);
  return {float(a / norm), float(b / norm), float(c / norm)};
}

TEST(ComputeWindowTextures, equalTheDefinitionInEveryWindow) {
  RandomInputs random(1);
  WindowTexturesWorkspace workspace;
  std::array<cv::Mat1f, kTextureSize> textures;
  for (int type : {CV_8UC3, CV_8UC1}) {
    const cv::Mat image = random.noise({47, 39}, type);
    const ColorPalette palette(image, cv::Mat1b(image.size(), uchar(255)),
                               cv::Mat1b(image.size(), uchar(0)), {2, 0.0});
    FramePixels pixels(palette, image);
    for (const cv::Point& origin : {cv::Point(5, 4), cv::Point(-20, -9), cv::Point(30, 28),
                                    cv::Point(300, 100), cv::Point(-90, 10)}) {
      for (int step : {1, 2, 3}) {
        for (int cells : {1, 2, 5, 8}) {
          const WindowLattice lattice{origin, step, cells, {7, 5}};
          computeWindowTextures(pixels, lattice, textures, workspace);
          for (int row = 0; row < lattice.size.height; ++row) {
            for (int column = 0; column < lattice.size.width; ++column) {
              const WindowTexture expected = slowTexture(image, lattice, {column, row});
              for (size_t i = 0; i < kTextureSize; ++i) {
                ASSERT_EQ(lattice.size, textures[i].size());
                ASSERT_NEAR(expected[i], textures[i](row, column), 1e-4)
                    << "element " << i << ", origin " << origin << ", step " << step << ", cells "
                    << cells;
              }
            }
          }
        }
      }
    }
  }
}

TEST(TextureOf, tellsEdgesApart) {
  const auto bright = [](const WindowTexture& texture) {
    return std::vector<bool>{texture[0] > 0.9F, texture[1] > 0.9F, texture[2] > 0.9F};
  };
  EXPECT_EQ((std::vector<bool>{true, false, false}), bright(textureOf(200, 50, 200, 50)));
  EXPECT_EQ((std::vector<bool>{false, true, false}), bright(textureOf(200, 200, 50, 50)));
  EXPECT_EQ((std::vector<bool>{false, false, true}), bright(textureOf(200, 50, 50, 200)));
}

TEST(TextureOf, forgetsBrightnessAndContrast) {
  const WindowTexture strong = textureOf(200, 100, 150, 50);
  const WindowTexture dim = textureOf(120, 70, 95, 45);
  for (size_t i = 0; i < kTextureSize; ++i) EXPECT_NEAR(strong[i], dim[i], 0.01);
  for (float value : textureOf(90, 90, 90, 90)) EXPECT_EQ(0.0F, value);
}

TEST(TextureOf, isShorterThanOne) {
  RandomInputs random(2);
  for (int repeat = 0; repeat < 100; ++repeat) {
    const auto level = [&] { return static_cast<float>(random.integer(0, 255)); };
    const WindowTexture t = textureOf(level(), level(), level(), level());
    EXPECT_LT(t[0] * t[0] + t[1] * t[1] + t[2] * t[2], 1.0F);
  }
}

}  // namespace
}  // namespace chain_tracker
