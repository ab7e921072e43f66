// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/frame_pixels.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "support/brute_force.h"
#include "support/random_inputs.h"

namespace chain_tracker {
namespace {

ColorPalette paletteOf(const cv::Mat& image) {
  cv::Mat1b object(image.size(), uchar(0));
  object.colRange(0, image.cols / 2).setTo(255);
  return {image, object, cv::Mat1b(~object), {6, 0.3}};
}

cv::Rect someRegion(RandomInputs& random) {
  return {random.integer(-30, 60), random.integer(-30, 50), random.integer(1, 40),
          random.integer(1, 40)};
}

std::vector<cv::Point> pixelsOf(const cv::Rect& region) {
  std::vector<cv::Point> pixels;
  for (int y = region.y; y < region.br().y; ++y) {
    for (int x = region.x; x < region.br().x; ++x) pixels.emplace_back(x, y);
  }
  return pixels;
}

/// Codes outside the image are 0 in every channel.
void expectCodes(const cv::Mat1b& all, const cv::Rect& region, const cv::Mat1b& entries) {
  const cv::Rect image(cv::Point(), all.size());
  ASSERT_EQ(region.size(), entries.size());
  for (int y = 0; y < region.height; ++y) {
    for (int x = 0; x < region.width; ++x) {
      const cv::Point pixel(region.x + x, region.y + y);
      const int expected = image.contains(pixel) ? all(pixel) : 0;
      ASSERT_EQ(expected, entries(y, x)) << "pixel " << pixel << " of " << region;
    }
  }
}

void expectGrey(const cv::Mat1b& all, const cv::Rect& region, const cv::Mat1b& grey) {
  ASSERT_EQ(region.size(), grey.size());
  for (int y = 0; y < region.height; ++y) {
    for (int x = 0; x < region.width; ++x) {
      const int row = std::clamp(region.y + y, 0, all.rows - 1);
      const int column = std::clamp(region.x + x, 0, all.cols - 1);
      ASSERT_EQ(all(row, column), grey(y, x)) << x << ", " << y << " of " << region;
    }
  }
}

/// Of the whole image, whose border pixels go on outside it.
cv::Mat1b edgesOf(const cv::Mat1b& grey) {
  cv::Mat1b bordered;
  cv::copyMakeBorder(grey, bordered, 1, 1, 1, 1, cv::BORDER_REPLICATE);
  cv::Mat1b edges(grey.size());
  EdgeDirections().compute(bordered, edges);
  return edges;
}

/// Regions inside the image, across its border and far outside, some of them known already.
TEST(FramePixels, equalThoseOfTheWholeImageInAnyOrder) {
  RandomInputs random(1);
  for (int type : {CV_8UC3, CV_8UC1}) {
    const cv::Mat first = random.noise({53, 41}, type);
    const ColorPalette palette = paletteOf(first);
    FramePixels pixels(palette);
    for (int frame = 0; frame < 4; ++frame) {
      const cv::Mat image = random.noise({53, 41}, type);
      pixels.show(image);
      const cv::Mat1b entries = brute_force::entriesOf(image, palette);
      cv::Mat1b grey = image;
      if (type == CV_8UC3) cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
      const cv::Mat1b edges = edgesOf(grey);
      for (int i = 0; i < 30; ++i) {
        const cv::Rect region = i == 7 ? cv::Rect(-300, 200, 9, 5) : someRegion(random);
        expectCodes(entries, region, pixels.codes(Channel::kColors, region));
        expectCodes(edges, region, pixels.codes(Channel::kEdges, region));
        expectGrey(grey, region, pixels.grey(region));
      }
    }
  }
}

/// The object's pixels one by one.
TEST(FramePixels, objectColorIsTheMeanOfItsPixels) {
  RandomInputs random(3);
  for (int type : {CV_8UC3, CV_8UC1}) {
    const cv::Mat image = random.noise({53, 41}, type);
    const ColorPalette palette = paletteOf(image);
    const cv::Mat1b entries = brute_force::entriesOf(image, palette);
    FramePixels pixels(palette, image);
    for (int i = 0; i < 40; ++i) {
      const cv::Rect region = i == 7 ? cv::Rect(-300, 200, 9, 5) : someRegion(random);
      cv::Vec3d sum;
      int own = 0;
      for (const cv::Point& pixel : pixelsOf(region & cv::Rect(cv::Point(), image.size()))) {
        if (entries(pixel) == ColorPalette::kOther) continue;
        ++own;
        sum += type == CV_8UC3 ? cv::Vec3d(image.at<cv::Vec3b>(pixel))
                               : cv::Vec3d::all(image.at<uchar>(pixel));
      }
      const ObjectColor color = pixels.objectColor(region);
      ASSERT_NEAR(static_cast<double>(own) / region.area(), color.share, 1e-12) << region;
      ASSERT_LT(cv::norm(sum / std::max(1, own) - color.mean), 1e-9) << region;
    }
  }
}

TEST(FramePixels, entriesAreThoseInTheLightOfTheFrame) {
  const cv::Mat image = RandomInputs(4).noise({53, 41}, CV_8UC3);
  const ColorPalette palette = paletteOf(image);
  ChannelGains gains;
  gains.steps = {90, 128, 200};
  const cv::Rect all(cv::Point(), image.size());
  cv::Mat1b expected;
  palette.classify(image, all, gains, expected);
  FramePixels pixels(palette, image);
  EXPECT_NE(0, cv::countNonZero(expected != pixels.entries(all)));
  pixels.show(image, gains);
  EXPECT_EQ(0, cv::countNonZero(expected != pixels.entries(all)));
  pixels.show(image);
  EXPECT_NE(0, cv::countNonZero(expected != pixels.entries(all))) << "the gains are of one frame";
}

TEST(FramePixels, areComputedOnce) {
  RandomInputs random(2);
  cv::Mat image = random.noise({50, 40}, CV_8UC3);
  const ColorPalette palette = paletteOf(image);
  FramePixels pixels(palette, image);
  const cv::Rect region(5, 6, 30, 20);
  const cv::Mat1b entries = pixels.entries(region).clone();
  const cv::Mat1b grey = pixels.grey(region).clone();
  image.setTo(cv::Scalar::all(0));
  const cv::Rect part(10, 8, 7, 9);
  EXPECT_EQ(0, cv::countNonZero(entries(part - region.tl()) != pixels.entries(part)));
  EXPECT_EQ(0, cv::countNonZero(grey(part - region.tl()) != pixels.grey(part)));
  pixels.show(image);
  EXPECT_EQ(0, cv::countNonZero(pixels.grey(part)));
}

}  // namespace
}  // namespace chain_tracker
