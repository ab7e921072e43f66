// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/object_appearance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "support/map_difference.h"
#include "support/random_inputs.h"

namespace chain_tracker {
namespace {

const cv::Scalar kRed(30, 30, 220);
const cv::Scalar kGreen(40, 200, 40);
const cv::Scalar kBlue(210, 60, 40);

/// A box, red on its left and green on its right, on blue; green again far away.
cv::Mat redAndGreenBox() {
  cv::Mat image(240, 320, CV_8UC3, kGreen);
  image(cv::Rect(100, 70, 120, 100)).setTo(kBlue);
  image(cv::Rect(130, 100, 60, 40)).setTo(kGreen);
  image(cv::Rect(130, 100, 30, 40)).setTo(kRed);
  return image;
}

ChainModel boxModel() {
  ChainModel model;
  model.segments[0].layout = Layout::kPlanar;
  model.segments[0].parts = 6;
  model.segments[0].margin = 0.0;
  return model;
}

ChainLayout boxLayout(const ChainModel& model) {
  return layOut(model, {{130, 100}, {189, 100}, {189, 139}, {130, 139}});
}

int entryAt(const ObjectAppearance& appearance, const cv::Mat& image, const cv::Point& pixel) {
  cv::Mat1b entry;
  appearance.palette().classify(image, {pixel.x, pixel.y, 1, 1}, {}, entry);
  return entry(0, 0);
}

TEST(ObjectAppearance, tellsTheObjectsColorsFromTheRing) {
  const cv::Mat image = redAndGreenBox();
  const ChainModel model = boxModel();
  const ObjectAppearance appearance(image, boxLayout(model), model.appearance);
  const int red = entryAt(appearance, image, {140, 120});
  const int green = entryAt(appearance, image, {180, 120});
  EXPECT_NE(ColorPalette::kOther, red);
  EXPECT_NE(ColorPalette::kOther, green);
  EXPECT_NE(red, green);
  EXPECT_EQ(ColorPalette::kOther, entryAt(appearance, image, {110, 80}));
}

TEST(ObjectAppearance, ringIsAsWideAsTheModelSays) {
  const cv::Mat image = redAndGreenBox();
  ChainModel model = boxModel();
  model.appearance.ring = 0.3;  // Ends in the blue, 15 of 30 pixels wide.
  EXPECT_NE(
      ColorPalette::kOther,
      entryAt(ObjectAppearance(image, boxLayout(model), model.appearance), image, {180, 120}));
  model.appearance.ring = 3.0;  // Reaches the green, which is most of it.
  EXPECT_EQ(
      ColorPalette::kOther,
      entryAt(ObjectAppearance(image, boxLayout(model), model.appearance), image, {180, 120}));
}

TEST(ObjectAppearance, keepsTheShareAndNumberOfColorsOfTheModel) {
  RandomInputs random(1);
  const cv::Mat image = random.noise({320, 240}, CV_8UC3);
  ChainModel model = boxModel();
  model.appearance.min_object_share = 0.0;
  model.appearance.palette_colors = 7;
  EXPECT_EQ(8, ObjectAppearance(image, boxLayout(model), model.appearance).palette().size());
  model.appearance.min_object_share = 0.5;
  EXPECT_LT(ObjectAppearance(image, boxLayout(model), model.appearance).palette().size(), 8);
}

TEST(ObjectAppearance, learnsEachPartWhereItLies) {
  const cv::Mat image = redAndGreenBox();
  const ChainModel model = boxModel();
  const ChainLayout layout = boxLayout(model);
  ObjectAppearance appearance(image, layout, model.appearance);
  FramePixels pixels(appearance.palette(), image);
  const SegmentLayout& segment = layout.segments[0];
  for (size_t k = 0; k < segment.parts.size(); ++k) {
    const cv::Point2d center = segment.image_from_segment.apply(segment.parts[k].position);
    EXPECT_EQ(learnPart(pixels, Channel::kColors, center, segment.parts[k].side),
              appearance.part(k, 0.0).colors)
        << "part " << k;
  }
  const auto red = static_cast<size_t>(entryAt(appearance, image, {140, 120}));
  const auto green = static_cast<size_t>(entryAt(appearance, image, {180, 120}));
  // The chain starts in the first column, on the left, and ends in the last.
  EXPECT_GT(appearance.part(0, 0.0).colors[red], 0.8F);
  EXPECT_EQ(appearance.part(0, 0.0).colors[green], 0.0F);
  EXPECT_GT(appearance.part(segment.parts.size() - 1, 0.0).colors[green], 0.8F);
  EXPECT_EQ(appearance.part(segment.parts.size() - 1, 0.0).colors[red], 0.0F);
}

TEST(ObjectAppearance, learnsTheStrokeOfALine) {
  cv::Mat image(200, 200, CV_8UC3, kBlue);
  image(cv::Rect(20, 95, 160, 11)).setTo(kRed);
  ChainModel model;
  model.segments[0].layout = Layout::kDeformable;
  model.segments[0].parts = 12;
  model.segments[0].aspect = 0.07;
  const ChainLayout layout = layOut(model, {{20, 100}, {180, 100}});
  ObjectAppearance appearance(image, layout, model.appearance);
  EXPECT_NE(ColorPalette::kOther, entryAt(appearance, image, {100, 100}));
  EXPECT_EQ(ColorPalette::kOther, entryAt(appearance, image, {100, 150}));
}

/// What a window shows, pixel by pixel: the codes of what is known of it.
struct WindowTwin {
  double seen = 0.0;                  ///< share inside the image
  double known = 0.0;                 ///< share that is not of the object beyond the image
  std::map<int, double> colors = {};  ///< shares in the known
};

WindowTwin lookPixelByPixel(const ObjectAppearance& appearance, const cv::Mat& image,
                            const cv::Rect& object, const cv::Rect2d& window) {
  WindowTwin twin;
  const cv::Rect pixels(cvRound(window.x), cvRound(window.y), cvRound(window.width),
                        cvRound(window.height));
  const double one = 1.0 / pixels.area();
  for (int y = pixels.y; y < pixels.br().y; ++y) {
    for (int x = pixels.x; x < pixels.br().x; ++x) {
      const bool is_seen = cv::Rect(cv::Point(), image.size()).contains({x, y});
      if (is_seen) twin.seen += one;
      if (!is_seen && object.contains({x, y})) continue;
      twin.known += one;
      twin.colors[is_seen ? entryAt(appearance, image, {x, y}) : ColorPalette::kOther] += one;
    }
  }
  for (auto& [entry, share] : twin.colors) share /= twin.known;
  return twin;
}

/// What the image does not show of the object is not taken for background.
TEST(ObjectAppearance, isThatOfWhatTheImageShows) {
  const ChainModel model = boxModel();
  int unknown = 0;
  for (int outside : {0, 4, 10, 16, 28}) {
    const cv::Mat image = redAndGreenBox()(cv::Rect(130 + outside, 60, 100, 100));
    const cv::Rect object(-outside, 40, 60, 40);
    const double right = object.br().x - 1;
    const ChainLayout layout =
        layOut(model, {{double(object.x), 40}, {right, 40}, {right, 79}, {double(object.x), 79}});
    ObjectAppearance appearance(image, layout, model.appearance);
    const SegmentLayout& segment = layout.segments[0];
    for (size_t k = 0; k < segment.parts.size(); ++k) {
      SCOPED_TRACE("part " + std::to_string(k) + ", outside " + std::to_string(outside));
      const double side = std::round(segment.parts[k].side);
      const cv::Point2d corner = segment.image_from_segment.apply(segment.parts[k].position) -
                                 0.5 * cv::Point2d(side - 1, side - 1);
      const WindowTwin twin =
          lookPixelByPixel(appearance, image, object, {corner.x, corner.y, side, side});
      const PartAppearance& part = appearance.part(k, 0.0);
      if (part.known == 0.0F) {
        ++unknown;
        EXPECT_GT(0.3, twin.seen);
        continue;
      }
      EXPECT_LT(0.2, twin.seen);
      EXPECT_NEAR(twin.known, part.known, 0.05);
      for (const auto& [entry, share] : twin.colors) {
        const double root = part.colors[static_cast<size_t>(entry)];
        EXPECT_NEAR(share, root * root, 0.06) << "entry " << entry;
      }
    }
  }
  EXPECT_LT(0, unknown);
}

/// Turned, a window of an object at the border has corners outside, but the object has not.
TEST(ObjectAppearance, takesWhatIsBesideTheObjectOutsideTheImageForBackground) {
  const ChainModel model = boxModel();
  const cv::Mat image = redAndGreenBox()(cv::Rect(130, 60, 100, 100));
  const ChainLayout layout = layOut(model, {{0, 40}, {59, 40}, {59, 79}, {0, 79}});
  ObjectAppearance appearance(image, layout, model.appearance);
  const PartAppearance& part = appearance.part(0, CV_PI / 4.0);
  EXPECT_EQ(1.0F, part.known);
  EXPECT_LT(0.2F, part.colors[ColorPalette::kOther]);
}

/// The image turned about the part's centre shows in the upright window what was learned for that
/// turn; the twin turns the image, not the window.
TEST(ObjectAppearance, ofATurnedPartIsThatOfTheTurnedImage) {
  const cv::Mat image = redAndGreenBox();
  const ChainModel model = boxModel();
  const ChainLayout layout = boxLayout(model);
  ObjectAppearance appearance(image, layout, model.appearance);
  const SegmentLayout& segment = layout.segments[0];
  for (double turn : {0.4, -0.8, 1.6, 3.1}) {
    for (size_t k = 0; k < segment.parts.size(); ++k) {
      const cv::Point2d center = segment.image_from_segment.apply(segment.parts[k].position);
      cv::Mat turned;
      const double degrees = -turn * 180.0 / CV_PI;  // OpenCV counts against the image's y axis
      cv::warpAffine(image, turned, cv::getRotationMatrix2D(center, degrees, 1.0), image.size(),
                     cv::INTER_NEAREST);
      FramePixels pixels(appearance.palette(), turned);
      const RootHistogram expected =
          learnPart(pixels, Channel::kColors, center, segment.parts[k].side);
      const RootHistogram& actual = appearance.part(k, turn).colors;
      ASSERT_EQ(expected.size(), actual.size());
      for (size_t entry = 0; entry < expected.size(); ++entry) {
        EXPECT_NEAR(expected[entry] * expected[entry], actual[entry] * actual[entry], 0.04)
            << "part " << k << ", turn " << turn << ", entry " << entry;
      }
    }
  }
}

/// The middles of the red parts are red, those of the green ones green, however they are turned.
TEST(ObjectAppearance, middlesOfPartsHaveTheirColors) {
  const ChainModel model = boxModel();
  const ChainLayout layout = boxLayout(model);
  ObjectAppearance appearance(redAndGreenBox(), layout, model.appearance);
  const SegmentLayout& segment = layout.segments[0];
  for (size_t k = 0; k < segment.parts.size(); ++k) {
    const cv::Point2d center = segment.image_from_segment.apply(segment.parts[k].position);
    if (std::abs(center.x - 160.0) < 5.0) continue;
    const cv::Scalar expected = center.x < 160.0 ? kRed : kGreen;
    for (double turn : {0.0, 0.5, 2.0}) {
      const ObjectColor& middle = appearance.part(k, turn).middle;
      EXPECT_EQ(1.0, middle.share) << "part " << k;
      EXPECT_LT(cv::norm(middle.mean - cv::Vec3d(expected[0], expected[1], expected[2])), 1e-9)
          << "part " << k;
    }
  }
}

TEST(MiddleOfWindow, liesAroundItsCenter) {
  EXPECT_EQ(cv::Rect(95, 45, 10, 10), middleOfWindow({99.6, 49.6}, 20.0));
  EXPECT_EQ(cv::Rect(96, 46, 8, 8), middleOfWindow({99.6, 49.6}, 11.0)) << "no fewer than 8";
  EXPECT_EQ(cv::Rect(99, 49, 3, 3), middleOfWindow({99.6, 50.4}, 3.0)) << "all of a small one";
}

/// Red is darker than green: the pattern of the window astride both turns with the object.
TEST(ObjectAppearance, textureTurnsWithTheObject) {
  ChainModel model = boxModel();
  model.segments[0].parts = 2;
  model.segments[0].layout = Layout::kElongated;
  const ChainLayout layout = layOut(model, {{150, 120}, {170, 120}});
  ObjectAppearance appearance(redAndGreenBox(), layout, model.appearance);
  const WindowTexture upright = appearance.part(0, 0.0).texture;
  EXPECT_LT(upright[0], -0.5F) << "darker on the left";
  EXPECT_NEAR(0.0F, upright[1], 0.2F);
  const WindowTexture quarter = appearance.part(0, CV_PI / 2.0).texture;
  EXPECT_LT(quarter[1], -0.5F) << "the left has become the top";
  EXPECT_NEAR(0.0F, quarter[0], 0.2F);
}

/// It is brighter on the right of the window astride both.
TEST(ObjectAppearance, edgesTurnWithTheObject) {
  ChainModel model = boxModel();
  model.segments[0].parts = 2;
  model.segments[0].layout = Layout::kElongated;
  const cv::Mat image = redAndGreenBox();
  const ChainLayout layout = layOut(model, {{150, 120}, {170, 120}});
  ObjectAppearance appearance(image, layout, model.appearance);
  const SegmentLayout& segment = layout.segments[0];
  FramePixels pixels(appearance.palette(), image);
  const cv::Point2d center = segment.image_from_segment.apply(segment.parts[0].position);
  EXPECT_EQ(learnPart(pixels, Channel::kEdges, center, segment.parts[0].side),
            appearance.part(0, 0.0).edges);
  const auto strongest = [&](double turn) {
    const RootHistogram& edges = appearance.part(0, turn).edges;
    return std::max_element(edges.begin() + 1, edges.end()) - edges.begin();
  };
  EXPECT_EQ(edgeCode(100.0F, 0.0F), strongest(0.0));
  EXPECT_EQ(edgeCode(100.0F, 100.0F), strongest(CV_PI / 4.0));
  EXPECT_EQ(edgeCode(0.0F, 100.0F), strongest(CV_PI / 2.0));
  EXPECT_EQ(edgeCode(-100.0F, 0.0F), strongest(CV_PI));
}

TEST(ObjectAppearance, roundsTurnsToTwentiethsOfARadian) {
  const ChainModel model = boxModel();
  ObjectAppearance appearance(redAndGreenBox(), boxLayout(model), model.appearance);
  EXPECT_EQ(&appearance.part(2, 0.78), &appearance.part(2, 0.82));
  EXPECT_NE(&appearance.part(2, 0.78), &appearance.part(2, 0.77));
  EXPECT_EQ(&appearance.part(2, 0.02), &appearance.part(2, -0.02));
}

}  // namespace
}  // namespace chain_tracker
