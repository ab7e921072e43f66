// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/color_palette.h"

#include <set>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "support/map_difference.h"
#include "support/random_inputs.h"

namespace chain_tracker {
namespace {

const cv::Scalar kRed(30, 30, 220);
const cv::Scalar kGreen(40, 200, 40);
const cv::Scalar kBlue(210, 60, 40);
const cv::Rect kObject(20, 15, 40, 30);

/// An object in the middle of an image of one background colour; the ring is all the rest.
struct Scene {
  cv::Mat image;
  cv::Mat1b object;
  cv::Mat1b ring;

  explicit Scene(const cv::Scalar& background, int type = CV_8UC3)
      : image(60, 80, type, background), object(60, 80, uchar(0)) {
    object(kObject).setTo(255);
    ring = ~object;
  }
  Scene& paint(const cv::Rect& region, const cv::Scalar& color) {
    image(region).setTo(color);
    return *this;
  }
  ColorPalette palette(const PaletteOptions& options = {}) const {
    return {image, object, ring, options};
  }
};

cv::Mat1b classified(const ColorPalette& palette, const cv::Mat& image) {
  cv::Mat1b entries;
  palette.classify(image, cv::Rect(cv::Point(), image.size()), {}, entries);
  return entries;
}

int entryAt(const ColorPalette& palette, const cv::Mat& image, const cv::Point& pixel) {
  return classified(palette, image)(pixel);
}

/// The entries found in a region.
std::set<int> entriesIn(const ColorPalette& palette, const cv::Mat& image, const cv::Rect& region) {
  const cv::Mat1b entries = classified(palette, image)(region);
  return {entries.begin(), entries.end()};
}

const std::set<int> kOnlyOther = {ColorPalette::kOther};

Scene noiseScene(int type, std::uint64_t seed) {
  Scene scene(cv::Scalar(), type);
  scene.image = RandomInputs(seed).noise(scene.image.size(), type);
  return scene;
}

TEST(ColorPalette, sameInputGivesTheSamePaletteWhateverTheGenerator) {
  for (int type : {CV_8UC3, CV_8UC1}) {
    const Scene scene = noiseScene(type, 1);
    cv::theRNG().state = 12345;
    const ColorPalette first = scene.palette();
    cv::theRNG().state = 67890;
    const ColorPalette second = scene.palette();
    ASSERT_GT(first.size(), 4);
    EXPECT_EQ(first.size(), second.size());
    EXPECT_EQ("", firstDifference(classified(first, scene.image), classified(second, scene.image)));
  }
}

TEST(ColorPalette, leavesTheCallersGeneratorAlone) {
  cv::theRNG().state = 4242;
  const Scene scene = noiseScene(CV_8UC3, 2);
  const ColorPalette palette = scene.palette();
  EXPECT_EQ(4242U, cv::theRNG().state);
}

TEST(ColorPalette, isTheSameWhetherPreparedForOrNot) {
  const Scene scene = noiseScene(CV_8UC3, 6);
  const cv::Mat1b unprepared = classified(scene.palette(), scene.image);
  cv::theRNG().state = 4242;
  prepareForPalettes();
  EXPECT_EQ(4242U, cv::theRNG().state);
  EXPECT_EQ("", firstDifference(unprepared, classified(scene.palette(), scene.image)));
}

TEST(ColorPalette, differentColorsOfTheObjectGetDifferentEntries) {
  Scene scene(kBlue);
  scene.paint(kObject, kRed).paint({20, 15, 20, 30}, kGreen);
  const ColorPalette palette = scene.palette();
  const int green = entryAt(palette, scene.image, {25, 20});
  const int red = entryAt(palette, scene.image, {50, 20});
  EXPECT_NE(green, red);
  EXPECT_NE(ColorPalette::kOther, green);
  EXPECT_NE(ColorPalette::kOther, red);
  EXPECT_EQ(kOnlyOther, entriesIn(palette, scene.image, {0, 0, 80, 10}));
}

TEST(ColorPalette, colorsFrequentInTheRingBecomeOther) {
  Scene scene(kGreen);
  scene.paint(kObject, kRed).paint({20, 15, 20, 30}, kGreen);
  const ColorPalette palette = scene.palette();
  EXPECT_EQ(kOnlyOther, entriesIn(palette, scene.image, {20, 15, 20, 30}));
  EXPECT_EQ(0U, entriesIn(palette, scene.image, {40, 15, 20, 30}).count(ColorPalette::kOther));
}

/// Green covers half the object and a quarter of the ring: its share is 0.5 / 0.75.
TEST(ColorPalette, shareOfTheObjectDecides) {
  Scene scene(kBlue);
  scene.paint({0, 0, 20, 45}, kGreen).paint(kObject, kRed).paint({20, 15, 20, 30}, kGreen);
  ASSERT_EQ(3600, cv::countNonZero(scene.ring));
  const auto isOwn = [&](double min_object_share) {
    const ColorPalette palette = scene.palette({24, min_object_share});
    return entryAt(palette, scene.image, {25, 20}) != ColorPalette::kOther;
  };
  EXPECT_TRUE(isOwn(0.0));
  EXPECT_TRUE(isOwn(0.6));
  EXPECT_TRUE(isOwn(0.66));
  EXPECT_FALSE(isOwn(0.68));
  EXPECT_FALSE(isOwn(0.8));
}

TEST(ColorPalette, sizesOfObjectAndRingDoNotCount) {
  Scene scene(kGreen);
  scene.paint(kObject, kGreen).paint({20, 15, 8, 30}, kRed);
  // Green: 4 of 5 of the object and all of the ring, a share of 0.8 / 1.8.
  scene.ring.setTo(0);
  scene.ring(cv::Rect(0, 0, 5, 5)).setTo(255);
  const auto entries = [&](double min_object_share) {
    const ColorPalette palette = scene.palette({24, min_object_share});
    return entryAt(palette, scene.image, {50, 20});
  };
  EXPECT_EQ(ColorPalette::kOther, entries(0.46));
  EXPECT_NE(ColorPalette::kOther, entries(0.43));
}

TEST(ColorPalette, colorOfTheLargestShareStaysWhenNoneIsTheObjects) {
  Scene scene(kGreen);
  const ColorPalette palette = scene.paint(kObject, kGreen).palette({24, 0.9});
  EXPECT_NE(ColorPalette::kOther, entryAt(palette, scene.image, {30, 30}));
}

std::string textOf(const cv::Scalar& object, const cv::Scalar& background) {
  std::ostringstream text;
  text << "object " << object << " on " << background;
  return text.str();
}

TEST(ColorPalette, objectOfOneColorIsToldFromItsRing) {
  RandomInputs random(3);
  for (int repeat = 0; repeat < 60; ++repeat) {
    const cv::Scalar dark(random.integer(0, 80), random.integer(0, 80), random.integer(0, 80));
    const cv::Scalar bright = dark + cv::Scalar(150, 150, 150);
    for (int type : {CV_8UC3, CV_8UC1}) {
      SCOPED_TRACE(textOf(dark, bright) + (type == CV_8UC1 ? ", grey" : ", colour"));
      Scene scene(bright, type);
      const ColorPalette palette = scene.paint(kObject, dark).palette();
      const std::set<int> on_object = entriesIn(palette, scene.image, kObject);
      EXPECT_EQ(1U, on_object.size());
      EXPECT_EQ(0U, on_object.count(ColorPalette::kOther));
      EXPECT_EQ(kOnlyOther, entriesIn(palette, scene.image, {0, 0, 80, 15}));
    }
  }
}

TEST(ColorPalette, toldApartInAGreyImage) {
  Scene scene(cv::Scalar(200), CV_8UC1);
  scene.paint(kObject, cv::Scalar(20)).paint({20, 15, 20, 30}, cv::Scalar(110));
  const ColorPalette palette = scene.palette();
  const int grey = entryAt(palette, scene.image, {25, 20});
  const int black = entryAt(palette, scene.image, {50, 20});
  EXPECT_NE(grey, black);
  EXPECT_NE(ColorPalette::kOther, grey);
  EXPECT_NE(ColorPalette::kOther, black);
  EXPECT_EQ(kOnlyOther, entriesIn(palette, scene.image, {0, 0, 80, 15}));
}

/// The ring is 1600 times as large as the object, and blue is on a tenth of that.
TEST(ColorPalette, smallObjectInALargeRingIsNotOverlooked) {
  cv::Mat image(400, 400, CV_8UC3, kGreen);
  cv::Mat1b object(image.size(), uchar(0));
  object(cv::Rect(200, 200, 20, 5)).setTo(255);
  image.setTo(kRed, object);
  image(cv::Rect(203, 200, 2, 5)).setTo(kBlue);
  const ColorPalette palette(image, object, cv::Mat1b(~object), {});
  EXPECT_EQ(ColorPalette::kOther, entryAt(palette, image, {0, 0}));
  EXPECT_NE(ColorPalette::kOther, entryAt(palette, image, {210, 202}));
  EXPECT_NE(ColorPalette::kOther, entryAt(palette, image, {203, 202}));
  EXPECT_NE(entryAt(palette, image, {210, 202}), entryAt(palette, image, {203, 202}));
}

TEST(ColorPalette, worksWithFewerPixelsThanColors) {
  Scene scene(kGreen);
  scene.object.setTo(0);
  scene.object(30, 30) = 255;
  scene.ring.setTo(0);
  const ColorPalette palette = scene.palette();
  EXPECT_EQ(2, palette.size());
  EXPECT_NE(ColorPalette::kOther, entryAt(palette, scene.image, {30, 30}));
}

TEST(ColorPalette, entriesAreBelowItsSize) {
  for (int colors : {2, 3, 24, 254}) {
    const Scene scene = noiseScene(CV_8UC3, 4);
    const ColorPalette palette = scene.palette({colors, 0.0});
    EXPECT_EQ(colors + 1, palette.size());
    const std::set<int> entries = entriesIn(palette, scene.image, {0, 0, 80, 60});
    EXPECT_LT(*entries.rbegin(), palette.size());
    EXPECT_GE(static_cast<int>(entries.size()), colors * 9 / 10) << "colours were merged";
  }
}

TEST(Classify, pixelsOutsideTheImageAreOther) {
  Scene scene(kGreen);
  const ColorPalette palette = scene.paint(kObject, kRed).palette({24, 0.0});
  const cv::Rect image(0, 0, 80, 60);
  const cv::Mat1b whole = classified(palette, scene.image);
  ASSERT_EQ(0, cv::countNonZero(whole == ColorPalette::kOther));
  for (const cv::Rect& region :
       {cv::Rect(-5, -7, 30, 20), cv::Rect(70, 50, 30, 30), cv::Rect(-10, -10, 120, 100),
        cv::Rect(100, 0, 5, 5), cv::Rect(0, -50, 5, 5), cv::Rect(30, 20, 9, 9)}) {
    std::ostringstream text;
    text << region;
    SCOPED_TRACE(text.str());
    cv::Mat1b entries(7, 7, uchar(99));
    palette.classify(scene.image, region, {}, entries);
    cv::Mat1b expected(region.size(), ColorPalette::kOther);
    const cv::Rect inside = region & image;
    if (!inside.empty()) whole(inside).copyTo(expected(inside - region.tl()));
    EXPECT_EQ("", firstDifference(expected, entries));
  }
}

/// The twin multiplies the image itself.
TEST(Classify, gainsAreThoseOfTheImagesChannels) {
  RandomInputs random(6);
  for (int type : {CV_8UC3, CV_8UC1}) {
    const Scene scene = noiseScene(type, 6);
    const ColorPalette palette = scene.palette();
    const cv::Rect all(cv::Point(), scene.image.size());
    for (int repeat = 0; repeat < 30; ++repeat) {
      ChannelGains gains;
      cv::Mat brighter = scene.image.clone();
      const int channels = brighter.channels();
      for (int& step : gains.steps)
        step = random.integer(ChannelGains::kLeast, ChannelGains::kMost);
      for (int i = 0; i < static_cast<int>(brighter.total()) * channels; ++i) {
        const int step = gains.steps[static_cast<size_t>(i % channels)];
        brighter.data[i] = cv::saturate_cast<uchar>(brighter.data[i] * step / ChannelGains::kUnit);
      }
      cv::Mat1b entries;
      palette.classify(scene.image, all, gains, entries);
      ASSERT_EQ("", firstDifference(classified(palette, brighter), entries));
    }
  }
}

TEST(Classify, viewOfALargerImageIsReadAsItself) {
  for (int type : {CV_8UC3, CV_8UC1}) {
    const Scene scene = noiseScene(type, 5);
    const ColorPalette palette = scene.palette();
    const cv::Mat view = scene.image(cv::Rect(13, 11, 40, 35));
    EXPECT_EQ("", firstDifference(classified(palette, view.clone()), classified(palette, view)));
    const cv::Rect part(13, 11, 40, 35);
    EXPECT_EQ("",
              firstDifference(classified(palette, scene.image)(part), classified(palette, view)));
  }
}

}  // namespace
}  // namespace chain_tracker
