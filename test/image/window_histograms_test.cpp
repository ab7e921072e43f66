// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/window_histograms.h"

#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/brute_force.h"
#include "support/random_inputs.h"

namespace chain_tracker {
namespace {

std::string textOf(const cv::Mat& image, const WindowLattice& lattice) {
  std::ostringstream text;
  text << "image " << image.size() << ", origin " << lattice.origin << ", step " << lattice.step
       << ", windows of " << lattice.window_cells << " cells, positions " << lattice.size;
  return text.str();
}

/// A palette of several entries, the same for every test image of its type.
ColorPalette somePalette(int type, int colors = 8) {
  RandomInputs random(99);
  const cv::Mat image = random.noise({40, 30}, type);
  cv::Mat1b object(image.size(), uchar(0));
  object(cv::Rect(10, 5, 20, 20)).setTo(255);
  return {image, object, cv::Mat1b(~object), {colors, 0.4}};
}

std::vector<bool> allEntries(const ColorPalette& palette) {
  return std::vector<bool>(static_cast<size_t>(palette.size()), true);
}

std::vector<cv::Mat1i> histogramsOf(const cv::Mat& image, const ColorPalette& palette,
                                    const WindowLattice& lattice) {
  std::vector<cv::Mat1i> counts;
  WindowHistogramsWorkspace workspace;
  FramePixels pixels(palette, image);
  computeWindowHistograms(pixels, Channel::kColors, lattice, allEntries(palette), counts,
                          workspace);
  for (cv::Mat1i& count : counts) count = count.clone();
  return counts;
}

/// Pixels counted window by window.
std::vector<cv::Mat1i> countedHistograms(const cv::Mat& image, const ColorPalette& palette,
                                         const WindowLattice& lattice, long long& pixels) {
  const cv::Mat1b entries = brute_force::entriesOf(image, palette);
  std::vector<cv::Mat1i> counts;
  for (int b = 0; b < palette.size(); ++b) counts.emplace_back(lattice.size);
  for (int row = 0; row < lattice.size.height; ++row) {
    for (int column = 0; column < lattice.size.width; ++column) {
      const cv::Point corner = lattice.origin + cv::Point(column, row) * lattice.step;
      const auto window = brute_force::countWindow(entries, palette.size(), corner,
                                                   lattice.window_cells * lattice.step);
      pixels += window.pixels;
      for (size_t b = 0; b < counts.size(); ++b) counts[b](row, column) = window.counts[b];
    }
  }
  return counts;
}

void expectEqualsCounting(const cv::Mat& image, const ColorPalette& palette,
                          const WindowLattice& lattice, const std::vector<cv::Mat1i>& counts) {
  SCOPED_TRACE(textOf(image, lattice));
  long long pixels = 0;
  const std::vector<cv::Mat1i> counted = countedHistograms(image, palette, lattice, pixels);
  const int side = lattice.window_cells * lattice.step;
  EXPECT_EQ(1LL * lattice.size.area() * side * side, pixels) << "not every pixel was counted";
  ASSERT_EQ(counted.size(), counts.size());
  for (size_t b = 0; b < counts.size(); ++b) {
    EXPECT_EQ(0, cv::countNonZero(counted[b] != counts[b])) << "entry " << b;
  }
}

TEST(WindowHistograms, equalCountingPixels) {
  RandomInputs random(1);
  for (int type : {CV_8UC3, CV_8UC1}) {
    const ColorPalette palette = somePalette(type);
    ASSERT_GT(palette.size(), 3);
    for (int step = 1; step <= 7; ++step) {
      for (int window_cells : {1, 2, 5}) {
        const cv::Mat image = random.noise({37, 23}, type);
        const WindowLattice lattice{{random.integer(-20, 20), random.integer(-20, 20)},
                                    step,
                                    window_cells,
                                    {random.integer(1, 9), random.integer(1, 9)}};
        expectEqualsCounting(image, palette, lattice, histogramsOf(image, palette, lattice));
      }
    }
  }
}

/// More than are counted at once, and cells that just fit and do not fit in a byte.
TEST(WindowHistograms, equalCountingPixelsOfManyColors) {
  RandomInputs random(5);
  const ColorPalette palette = somePalette(CV_8UC3, 150);
  ASSERT_GT(palette.size(), 64);
  const cv::Mat image = random.noise({90, 70}, CV_8UC3);
  for (int step : {5, 6, 15, 16}) {
    const WindowLattice lattice{{-7, 3}, step, 2, {4, 3}};
    expectEqualsCounting(image, palette, lattice, histogramsOf(image, palette, lattice));
  }
}

TEST(WindowHistograms, equalCountingPixelsOfTheSmallestImages) {
  RandomInputs random(2);
  const ColorPalette palette = somePalette(CV_8UC3);
  for (const cv::Size& size : {cv::Size(1, 1), cv::Size(1, 9), cv::Size(9, 1)}) {
    for (int step : {1, 2, 3, 7}) {
      const cv::Mat image = random.noise(size, CV_8UC3);
      for (const cv::Point& origin : {cv::Point(0, 0), cv::Point(-5, -3), cv::Point(3, 8)}) {
        const WindowLattice lattice{origin, step, 3, {4, 3}};
        expectEqualsCounting(image, palette, lattice, histogramsOf(image, palette, lattice));
        const WindowLattice one{origin, step, 1, {1, 1}};
        expectEqualsCounting(image, palette, one, histogramsOf(image, palette, one));
      }
    }
  }
}

TEST(WindowHistograms, equalCountingPixelsOfAViewOfALargerImage) {
  RandomInputs random(3);
  const ColorPalette palette = somePalette(CV_8UC3);
  const cv::Mat view = random.noise({50, 40}, CV_8UC3)(cv::Rect(7, 9, 21, 17));
  const WindowLattice lattice{{-4, -6}, 2, 4, {12, 10}};
  expectEqualsCounting(view, palette, lattice, histogramsOf(view, palette, lattice));
}

TEST(WindowHistograms, windowsOutsideTheImageHoldOnlyOther) {
  RandomInputs random(4);
  const ColorPalette palette = somePalette(CV_8UC3);
  const cv::Mat image = random.noise({20, 20}, CV_8UC3);
  for (const cv::Point& origin : {cv::Point(100, 0), cv::Point(0, -100), cv::Point(-300, 300)}) {
    const std::vector<cv::Mat1i> counts = histogramsOf(image, palette, {origin, 3, 2, {4, 4}});
    EXPECT_EQ(0, cv::countNonZero(counts[ColorPalette::kOther] != 36));
    for (size_t b = 1; b < counts.size(); ++b) {
      EXPECT_EQ(0, cv::countNonZero(counts[b])) << "entry " << b;
    }
  }
}

TEST(WindowHistograms, countEveryPixelOnce) {
  RandomInputs random(5);
  const ColorPalette palette = somePalette(CV_8UC3);
  const auto counts =
      histogramsOf(random.noise({64, 48}, CV_8UC3), palette, {{-8, -8}, 3, 6, {20, 15}});
  cv::Mat1i sums(15, 20, 0);
  for (const cv::Mat1i& count : counts) sums += count;
  EXPECT_EQ(0, cv::countNonZero(sums != 18 * 18));
}

TEST(WindowHistograms, workspaceOfOtherSizesLeavesNoTrace) {
  RandomInputs random(6);
  const ColorPalette colors = somePalette(CV_8UC3);
  const ColorPalette greys = somePalette(CV_8UC1);
  std::vector<cv::Mat1i> counts;
  WindowHistogramsWorkspace workspace;
  const auto check = [&](int type, const ColorPalette& palette, const WindowLattice& lattice) {
    const cv::Mat image = random.noise({30, 25}, type);
    FramePixels pixels(palette, image);
    computeWindowHistograms(pixels, Channel::kColors, lattice, allEntries(palette), counts,
                            workspace);
    expectEqualsCounting(image, palette, lattice, counts);
  };
  check(CV_8UC3, colors, {{-3, -3}, 2, 5, {14, 12}});
  check(CV_8UC1, greys, {{5, 2}, 1, 3, {4, 4}});
  // Cells of more pixels than a byte can count, and of as few again.
  check(CV_8UC3, colors, {{-40, -60}, 17, 2, {5, 4}});
  check(CV_8UC3, colors, {{-9, 10}, 4, 2, {6, 2}});
}

TEST(WindowHistograms, ofWantedEntriesAreThoseOfAll) {
  RandomInputs random(8);
  const ColorPalette palette = somePalette(CV_8UC3);
  const WindowLattice lattice{{-3, 4}, 2, 3, {9, 7}};
  const cv::Mat image = random.noise({30, 25}, CV_8UC3);
  const std::vector<cv::Mat1i> all = histogramsOf(image, palette, lattice);
  FramePixels pixels(palette, image);
  std::vector<cv::Mat1i> counts;
  WindowHistogramsWorkspace workspace;
  for (size_t first = 0; first < all.size(); ++first) {
    std::vector<bool> wanted(all.size(), false);
    for (size_t entry = first; entry < all.size(); entry += 3) wanted[entry] = true;
    computeWindowHistograms(pixels, Channel::kColors, lattice, wanted, counts, workspace);
    for (size_t entry = first; entry < all.size(); entry += 3) {
      EXPECT_EQ(0, cv::countNonZero(all[entry] != counts[entry])) << entry;
    }
  }
  computeWindowHistograms(pixels, Channel::kColors, lattice, std::vector<bool>(all.size(), false),
                          counts, workspace);
  EXPECT_EQ(all.size(), counts.size());
}

TEST(WindowLattice, centersFollowTheConventionForWindows) {
  // A window of 3 cells of 2 pixels at pixel 10 covers pixels 10 to 15.
  const WindowLattice lattice{{10, 20}, 2, 3, {5, 4}};
  EXPECT_EQ(cv::Point2d(12.5, 22.5), lattice.centerOf(0, 0));
  EXPECT_EQ(cv::Point2d(14.5, 28.5), lattice.centerOf(1, 3));
  EXPECT_EQ(cv::Point2d(13.5, 22.0), lattice.centerOf(0.5, -0.25));
}

TEST(WindowLattice, pixelsAreThoseOfAllWindows) {
  const WindowLattice lattice{{10, 20}, 2, 3, {5, 4}};
  EXPECT_EQ(cv::Rect(10, 20, 14, 12), lattice.pixels());
}

}  // namespace
}  // namespace chain_tracker
