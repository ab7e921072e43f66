// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/part_costs.h"

#include <cmath>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "chain_tracker/image/pixel_geometry.h"
#include "support/brute_force.h"
#include "support/lattice_candidates.h"
#include "support/map_difference.h"
#include "support/random_inputs.h"

namespace chain_tracker {
namespace {

ColorPalette somePalette(const cv::Mat& image) {
  cv::Mat1b object(image.size(), uchar(0));
  object(cv::Rect(image.cols / 4, image.rows / 4, image.cols / 2, image.rows / 2)).setTo(255);
  return {image, object, cv::Mat1b(~object), {8, 0.4}};
}

/// Squares of 8 pixels: windows near each other look alike, those far apart do not.
cv::Mat texture(RandomInputs& random, const cv::Size& size, int type) {
  cv::Mat image;
  cv::resize(random.noise(size / 8, type), image, size, 0.0, 0.0, cv::INTER_NEAREST);
  return image;
}

/// Top-left pixel of the window of `side` pixels centred nearest to a point.
cv::Point cornerOf(const cv::Point2d& center, int side) {
  return {static_cast<int>(std::lround(center.x - 0.5 * (side - 1))),
          static_cast<int>(std::lround(center.y - 0.5 * (side - 1)))};
}

double bhattacharyya(const brute_force::WindowCounts& a, const brute_force::WindowCounts& b) {
  double coefficient = 0.0;
  for (size_t entry = 0; entry < a.counts.size(); ++entry) {
    coefficient += std::sqrt(double(a.counts[entry]) / a.pixels * b.counts[entry] / b.pixels);
  }
  return coefficient;
}

std::string textOf(const CandidateGrid& grid) {
  std::ostringstream text;
  text << "origin " << grid.lattice.origin << ", step " << grid.lattice.step << ", windows of "
       << grid.lattice.window_cells << " cells, " << grid.states << " states";
  return text.str();
}

TEST(MakeCandidateGrid, middleStatesAreNearestToTheCenters) {
  RandomInputs random(1);
  for (int repeat = 0; repeat < 200; ++repeat) {
    const std::vector<cv::Point2d> centers = random.points(6, -100.0, 400.0);
    const int step = random.integer(1, 9);
    const CandidateGrid grid =
        gridAround(centers, random.real(4.0, 60.0), step, random.real(0.0, 50.0));
    SCOPED_TRACE(textOf(grid));
    EXPECT_EQ(1, grid.states.width % 2);
    EXPECT_EQ(1, grid.states.height % 2);
    for (size_t k = 0; k < centers.size(); ++k) {
      const cv::Point2d middle = grid.positionOf(k, cv::Point(grid.states / 2));
      EXPECT_LE(std::abs(middle.x - centers[k].x), 0.5 * step + 1e-9) << "part " << k;
      EXPECT_LE(std::abs(middle.y - centers[k].y), 0.5 * step + 1e-9) << "part " << k;
    }
  }
}

TEST(MakeCandidateGrid, reachesTheRadiusAroundTheMiddleStates) {
  RandomInputs random(2);
  for (int repeat = 0; repeat < 100; ++repeat) {
    const double radius = random.real(0.0, 50.0);
    const int step = random.integer(1, 9);
    const CandidateGrid grid = gridAround(random.points(3, 0.0, 99.0), 20.0, step, radius);
    const cv::Point2d first = grid.positionOf(1, {0.0, 0.0});
    const cv::Point2d middle = grid.positionOf(1, cv::Point(grid.states / 2));
    EXPECT_GE(middle.x - first.x, radius);
    EXPECT_GE(middle.y - first.y, radius);
    EXPECT_LE(middle.x - first.x, radius + step) << "farther than asked for";
  }
}

TEST(MakeCandidateGrid, latticeHoldsTheStatesOfAllPartsAndNoMore) {
  RandomInputs random(3);
  for (int repeat = 0; repeat < 100; ++repeat) {
    const CandidateGrid grid = gridAround(random.points(5, -50.0, 300.0), 20.0,
                                          random.integer(1, 9), random.real(1.0, 40.0));
    SCOPED_TRACE(textOf(grid));
    cv::Rect used;
    for (const cv::Point& corner : grid.corners) used |= cv::Rect(corner, grid.states);
    EXPECT_GE(used.x, 0);
    EXPECT_GE(used.y, 0);
    EXPECT_EQ(grid.lattice.size, cv::Size(used.br()));
  }
}

TEST(MakeCandidateGrid, windowsAreRoundedToWholeCells) {
  const auto cells = [](double side, int step) {
    return gridAround({{50, 50}}, side, step, 10.0).lattice.window_cells;
  };
  EXPECT_EQ(20, cells(20.4, 1));
  EXPECT_EQ(5, cells(20.4, 4));
  EXPECT_EQ(7, cells(20.4, 3));
  EXPECT_EQ(1, cells(2.0, 9));
}

class PartCostsOfChannel : public testing::TestWithParam<Channel> {};

TEST_P(PartCostsOfChannel, equalTheBhattacharyyaDistanceOfCountedPixels) {
  RandomInputs random(4);
  for (int type : {CV_8UC3, CV_8UC1}) {
    for (int step : {1, 2, 5}) {
      const cv::Mat image = texture(random, {70, 50}, type);
      const ColorPalette palette = somePalette(image);
      FramePixels pixels(palette, image);
      const int code_count = pixels.codeCount(GetParam());
      const cv::Point border(60, 40);
      const cv::Mat1b codes =
          pixels.codes(GetParam(), {-border, image.size() + cv::Size(2 * border)}).clone();
      // Parts inside the image, over its border, and outside it.
      const std::vector<cv::Point2d> centers = {{20, 21}, {36, 24}, {66, 40}, {-30, 10}};
      const double side = 13.0;
      const double weight = 3.5;
      const CandidateGrid grid = gridAround(centers, side, step, 7.0);
      SCOPED_TRACE(textOf(grid));
      std::vector<RootHistogram> parts;
      parts.reserve(centers.size());
      for (const cv::Point2d& center : centers) {
        parts.push_back(learnPart(pixels, GetParam(), center, side));
      }
      std::vector<cv::Mat1f> costs;
      PartCostsWorkspace workspace;
      computePartCosts(pixels, GetParam(), parts, grid, weight, costs, workspace);

      ASSERT_EQ(centers.size(), costs.size());
      for (size_t k = 0; k < centers.size(); ++k) {
        const auto learned =
            brute_force::countWindow(codes, code_count, border + cornerOf(centers[k], 13), 13);
        cv::Mat1d expected(grid.states);
        cv::Mat1d squared(grid.states);
        for (int row = 0; row < grid.states.height; ++row) {
          for (int column = 0; column < grid.states.width; ++column) {
            const int window = grid.lattice.window_cells * step;
            const cv::Point corner = cornerOf(grid.positionOf(k, cv::Point(column, row)), window);
            const auto seen = brute_force::countWindow(codes, code_count, border + corner, window);
            expected(row, column) = 1.0 - bhattacharyya(learned, seen);
            const double cost = costs[k](row, column);
            squared(row, column) = cost / weight * cost / weight;
            ASSERT_GE(cost, 0.0);
            ASSERT_LE(cost, weight);
          }
        }
        // Compared before the root, which magnifies rounding errors near zero.
        EXPECT_EQ("", firstDifference(expected, squared, 2e-6)) << "part " << k;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Channels, PartCostsOfChannel,
                         testing::Values(Channel::kColors, Channel::kEdges));

TEST(ComputePartCosts, nothingInCommonCostsTheWholeWeight) {
  const cv::Mat image(30, 30, CV_8UC3, cv::Scalar(20, 20, 200));
  const ColorPalette palette = somePalette(image);
  FramePixels pixels(palette, image);
  ASSERT_EQ(2, palette.size());
  const RootHistogram only_other = {1.0F, 0.0F};
  const CandidateGrid grid = gridAround({{15, 15}}, 8.0, 2, 4.0);
  std::vector<cv::Mat1f> costs;
  PartCostsWorkspace workspace;
  computePartCosts(pixels, Channel::kColors, {only_other}, grid, 6.0, costs, workspace);
  EXPECT_EQ("", firstDifference(cv::Mat1f(grid.states, 6.0F), costs[0]));
}

TEST(ComputePartCosts, partIsCheapestWhereItWasLearned) {
  RandomInputs random(5);
  const cv::Mat image = texture(random, {80, 80}, CV_8UC3);
  const ColorPalette palette = somePalette(image);
  FramePixels pixels(palette, image);
  const CandidateGrid grid = gridAround({{40, 40}}, 15.0, 1, 20.0);
  const cv::Point learned_state(27, 13);
  const RootHistogram part =
      learnPart(pixels, Channel::kColors, grid.positionOf(0, cv::Point2d(learned_state)), 15.0);
  std::vector<cv::Mat1f> costs;
  PartCostsWorkspace workspace;
  computePartCosts(pixels, Channel::kColors, {part}, grid, 1.0, costs, workspace);
  cv::Point cheapest;
  cv::minMaxLoc(costs[0], nullptr, nullptr, &cheapest);
  EXPECT_EQ(learned_state, cheapest);
}

TEST(ComputePartCosts, workspaceOfAnotherGridLeavesNoTrace) {
  RandomInputs random(6);
  const cv::Mat image = texture(random, {60, 60}, CV_8UC3);
  const ColorPalette palette = somePalette(image);
  FramePixels pixels(palette, image);
  const RootHistogram part = learnPart(pixels, Channel::kColors, {30, 30}, 12.0);
  std::vector<cv::Mat1f> reused;
  PartCostsWorkspace workspace;
  const std::vector<CandidateGrid> grids = {gridAround({{30, 30}, {40, 20}}, 12.0, 1, 9.0),
                                            gridAround({{12, 50}}, 12.0, 3, 5.0)};
  for (const CandidateGrid& grid : grids) {
    SCOPED_TRACE(textOf(grid));
    const std::vector<RootHistogram> parts(grid.corners.size(), part);
    computePartCosts(pixels, Channel::kColors, parts, grid, 2.0, reused, workspace);
    std::vector<cv::Mat1f> fresh;
    PartCostsWorkspace fresh_workspace;
    computePartCosts(pixels, Channel::kColors, parts, grid, 2.0, fresh, fresh_workspace);
    ASSERT_EQ(fresh.size(), reused.size());
    for (size_t k = 0; k < fresh.size(); ++k) {
      EXPECT_EQ("", firstDifference(fresh[k], reused[k])) << "part " << k;
    }
  }
}

TEST(ComputePartCosts, partsThatShareWindowsCostAsMuchAsAlone) {
  RandomInputs random(9);
  const cv::Mat image = texture(random, {90, 60}, CV_8UC3);
  const ColorPalette palette = somePalette(image);
  FramePixels pixels(palette, image);
  PartCostsWorkspace workspace;
  for (int repeat = 0; repeat < 50; ++repeat) {
    const std::vector<cv::Point2d> centers = random.points(8, 20.0, 50.0);
    const CandidateGrid grid =
        gridAround(centers, 12.0, random.integer(1, 3), random.real(2.0, 20.0));
    SCOPED_TRACE(textOf(grid));
    std::vector<RootHistogram> parts;
    parts.reserve(centers.size());
    for (const cv::Point2d& center : centers) {
      parts.push_back(learnPart(pixels, Channel::kColors, center, 12.0));
    }
    std::vector<cv::Mat1f> together;
    computePartCosts(pixels, Channel::kColors, parts, grid, 2.0, together, workspace);
    for (size_t k = 0; k < parts.size(); ++k) {
      CandidateGrid own = grid;
      own.corners = {grid.corners[k]};
      std::vector<cv::Mat1f> alone;
      PartCostsWorkspace fresh;
      computePartCosts(pixels, Channel::kColors, {parts[k]}, own, 2.0, alone, fresh);
      EXPECT_EQ("", firstDifference(alone[0], together[k])) << "part " << k;
    }
  }
}

TEST(ComputePartCosts, threadsChangeNothing) {
  RandomInputs random(11);
  const cv::Mat image = texture(random, {300, 200}, CV_8UC3);
  const ColorPalette palette = somePalette(image);
  FramePixels pixels(palette, image);
  PartCostsWorkspace many;
  for (const double spread : {30.0, 9000.0}) {
    for (int threads = 2; threads <= 5; ++threads) {
      const std::vector<cv::Point2d> centers = random.points(4, 0.0, spread);
      const CandidateGrid grid = gridAround(centers, 12.0, 1, 300.0);
      SCOPED_TRACE(textOf(grid) + ", threads " + std::to_string(threads));
      EXPECT_EQ(spread > 1000.0, grid.isSparse());
      const std::vector<RootHistogram> parts(
          centers.size(), learnPart(pixels, Channel::kColors, random.point(0.0, 200.0), 12.0));
      std::vector<cv::Mat1f> alone;
      PartCostsWorkspace one;
      computePartCosts(pixels, Channel::kColors, parts, grid, 2.0, alone, one);
      std::vector<cv::Mat1f> together;
      many.threads = threads;
      computePartCosts(pixels, Channel::kColors, parts, grid, 2.0, together, many);
      for (size_t k = 0; k < parts.size(); ++k) {
        EXPECT_EQ("", firstDifference(alone[k], together[k])) << "part " << k;
      }
    }
  }
}

TEST(LearnPart, countsTheWindowAroundTheCenter) {
  RandomInputs random(7);
  const cv::Mat image = texture(random, {60, 40}, CV_8UC3);
  const ColorPalette palette = somePalette(image);
  FramePixels pixels(palette, image);
  const cv::Mat1b entries = brute_force::entriesOf(image, palette);
  for (int repeat = 0; repeat < 100; ++repeat) {
    const int side = random.integer(1, 25);
    const cv::Point corner(random.integer(-20, 60), random.integer(-20, 60));
    const cv::Point2d center = cv::Point2d(corner) + 0.5 * cv::Point2d(side - 1, side - 1);
    const RootHistogram part =
        learnPart(pixels, Channel::kColors, center, side + random.real(-0.49, 0.49));
    const auto window = brute_force::countWindow(entries, palette.size(), corner, side);
    ASSERT_EQ(window.counts.size(), part.size());
    for (size_t entry = 0; entry < part.size(); ++entry) {
      EXPECT_NEAR(std::sqrt(double(window.counts[entry]) / window.pixels), part[entry], 1e-6)
          << "entry " << entry << " of " << side << " px at " << center;
    }
  }
}

TEST(LearnPart, interpolatesBetweenTheWindowsOfWholePixels) {
  RandomInputs random(8);
  const cv::Mat image = texture(random, {60, 40}, CV_8UC3);
  const ColorPalette palette = somePalette(image);
  FramePixels pixels(palette, image);
  const cv::Mat1b entries = brute_force::entriesOf(image, palette);
  const auto share = [&](const cv::Point& corner, int side, size_t entry) {
    const auto window = brute_force::countWindow(entries, palette.size(), corner, side);
    return double(window.counts[entry]) / window.pixels;
  };
  for (int repeat = 0; repeat < 50; ++repeat) {
    const int side = random.integer(4, 20);
    const cv::Point corner(random.integer(-10, 50), random.integer(-10, 30));
    const cv::Point2d rest = random.point(0.0, 0.999);
    const cv::Point2d center = cv::Point2d(corner) + rest + 0.5 * cv::Point2d(side - 1, side - 1);
    const RootHistogram part = learnPart(pixels, Channel::kColors, center, side);
    for (size_t entry = 0; entry < part.size(); ++entry) {
      const double expected =
          (1.0 - rest.x) * (1.0 - rest.y) * share(corner, side, entry) +
          rest.x * (1.0 - rest.y) * share(corner + cv::Point(1, 0), side, entry) +
          (1.0 - rest.x) * rest.y * share(corner + cv::Point(0, 1), side, entry) +
          rest.x * rest.y * share(corner + cv::Point(1, 1), side, entry);
      EXPECT_NEAR(expected, part[entry] * part[entry], 1e-5)
          << "entry " << entry << " of " << side << " px at " << center;
    }
  }
}

}  // namespace
}  // namespace chain_tracker
