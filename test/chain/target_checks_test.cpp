// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/target_checks.h"

#include <string>

#include <gtest/gtest.h>

#include "support/refusal.h"

namespace chain_tracker {
namespace {

TEST(TextOf, isWidthByHeight) { EXPECT_EQ("640x480", textOf(cv::Size(640, 480))); }

TEST(RequireModel, passesTheDefaults) {
  EXPECT_EQ("", refusalOf([] { requireModel(ChainModel()); }));
}

TEST(RequireModel, namesTheModelAndAllItsFaults) {
  ChainModel model;
  model.name = "mug";
  model.segments[0].parts = 1;
  model.appearance.weight = -3.0;
  EXPECT_EQ("", omissionsOf(refusalOf([&] { requireModel(model); }),
                            {"mug", "segments[0]/parts is 1", "[2, 200]", "appearance/weight is -3",
                             "[0.1, 1000]"}));
}

TEST(RequireImage, passesColorAndGrey) {
  EXPECT_EQ("", refusalOf([] { requireImage(cv::Mat(2, 3, CV_8UC3)); }));
  EXPECT_EQ("", refusalOf([] { requireImage(cv::Mat(2, 3, CV_8UC1)); }));
}

TEST(RequireImage, refusesAnEmptyOne) {
  EXPECT_EQ("", omissionsOf(refusalOf([] { requireImage(cv::Mat()); }), {"image", "empty"}));
  EXPECT_EQ("", omissionsOf(refusalOf([] { requireImage(cv::Mat(0, 5, CV_8UC3)); }), {"empty"}));
}

TEST(RequireImage, namesTheTypeItDoesNotTake) {
  const auto refusal = [](int type) {
    return refusalOf([type] { requireImage(cv::Mat(2, 3, type)); });
  };
  EXPECT_EQ("", omissionsOf(refusal(CV_8UC4), {"CV_8UC4", "CV_8UC3", "CV_8UC1"}));
  EXPECT_EQ("", omissionsOf(refusal(CV_16UC1), {"CV_16UC1"}));
  EXPECT_EQ("", omissionsOf(refusal(CV_32FC3), {"CV_32FC3"}));
  EXPECT_EQ("", omissionsOf(refusal(CV_8UC2), {"CV_8UC2"}));
  EXPECT_EQ("", omissionsOf(refusal(CV_8SC3), {"CV_8SC3"}));
}

TEST(RequireSameKind, passesTheSameKind) {
  const cv::Mat image(20, 30, CV_8UC3);
  EXPECT_EQ("", refusalOf([&] { requireSameKind(image, {30, 20}, CV_8UC3); }));
}

TEST(RequireSameKind, namesBothKinds) {
  const auto refusal = [](const cv::Mat& image) {
    return refusalOf([&] { requireSameKind(image, {30, 20}, CV_8UC3); });
  };
  EXPECT_EQ("", omissionsOf(refusal(cv::Mat(30, 20, CV_8UC3)), {"20x30", "30x20"}));
  EXPECT_EQ("", omissionsOf(refusal(cv::Mat(20, 31, CV_8UC3)), {"31x20", "30x20"}));
  EXPECT_EQ("", omissionsOf(refusal(cv::Mat(20, 30, CV_8UC1)), {"CV_8UC1", "CV_8UC3"}));
  EXPECT_EQ("", omissionsOf(refusal(cv::Mat(20, 30, CV_16UC3)), {"CV_16UC3"}));
  EXPECT_EQ("", omissionsOf(refusal(cv::Mat()), {"empty"}));
}

ChainLayout layoutWithParts(double side) {
  ChainLayout layout;
  layout.segments.emplace_back();
  layout.segments[0].name = "body";
  layout.segments[0].parts.assign(7, PartLayout{{0, 0}, side});
  return layout;
}

TEST(RequirePartsFit, passesPartsFromFourPixelsToTheShorterSide) {
  for (double side : {4.0, 10.0, 20.0}) {
    EXPECT_EQ("", refusalOf([&] { requirePartsFit(layoutWithParts(side), {30, 20}); })) << side;
    EXPECT_EQ("", refusalOf([&] { requirePartsFit(layoutWithParts(side), {20, 30}); })) << side;
  }
}

TEST(RequirePartsFit, namesPartsThatAreTooSmallOrTooLarge) {
  for (const std::string side : {"3.9", "20.1", "1000"}) {
    const auto refusal = refusalOf([&] {
      requirePartsFit(layoutWithParts(std::stod(side)), {30, 20});
    });
    EXPECT_EQ("", omissionsOf(refusal, {"7 parts", "body", side, "4", "20", "30x20"}));
  }
}

Silhouette box(double x, double y, double width, double height) {
  return {{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, 0.0};
}

TEST(RequireInside, passesATargetThatIsAtLeastHalfInside) {
  const cv::Size image(100, 80);
  // A box from pixel x to pixel x + 19 covers 20 pixels.
  for (const Silhouette& silhouette :
       {box(0, 0, 99, 79), box(40, 30, 19, 19), box(-10, 30, 19, 19), box(90, 30, 19, 19),
        box(40, -10, 19, 19), box(40, 70, 19, 19), box(-20, 0, 139, 79)}) {
    EXPECT_EQ("", refusalOf([&] { requireInside(silhouette, image); })) << silhouette.points[0];
  }
}

TEST(RequireInside, namesATargetThatIsMostlyOutside) {
  const cv::Size image(100, 80);
  for (const Silhouette& silhouette :
       {box(-11, 30, 19, 19), box(91, 30, 19, 19), box(40, -11, 19, 19), box(40, 71, 19, 19),
        box(-10, -10, 19, 19), box(200, 200, 19, 19), box(-200, -200, 1000, 1000)}) {
    EXPECT_EQ("", omissionsOf(refusalOf([&] { requireInside(silhouette, image); }), {"100x80"}))
        << silhouette.points[0];
  }
  EXPECT_EQ("", omissionsOf(refusalOf([&] { requireInside(box(91, 30, 19, 19), image); }),
                            {"x 91 to 110", "y 30 to 49", "half inside"}));
}

/// Its bounds are mostly inside, the line itself is nowhere.
TEST(RequireInside, refusesALineThatOnlyPassesRoundTheImage) {
  const Silhouette line{{{-8, -8}, {-8, 88}, {108, 88}}, 2.0};
  EXPECT_EQ("", omissionsOf(refusalOf([&] { requireInside(line, {100, 80}); }), {"100x80"}));
}

TEST(RequireInside, refusesALineOfWhichTheImageHoldsAnEnd) {
  const Silhouette line{{{20, 75}, {-8, 75}, {-8, 2}, {90, -9}}, 2.0};
  EXPECT_EQ("", omissionsOf(refusalOf([&] { requireInside(line, {100, 80}); }), {"100x80"}));
}

TEST(RequireInside, passesAStraightLineInside) {
  EXPECT_EQ("", refusalOf([] { requireInside({{{10, 10}, {90, 10}}, 2.0}, {100, 80}); }));
  EXPECT_EQ("", refusalOf([] { requireInside({{{10, 10}, {10, 70}}, 2.0}, {100, 80}); }));
}

TEST(RequireContrast, passesWhatHasAnOutline) {
  cv::Mat3b image(80, 100, cv::Vec3b(40, 40, 40));
  image(cv::Rect(30, 30, 20, 20)) = cv::Vec3b(40, 48, 40);
  EXPECT_EQ("", refusalOf([&] { requireContrast(image, box(30, 30, 19, 19)); }));
  EXPECT_EQ("", refusalOf([&] { requireContrast(image, box(-10, 30, 99, 19)); }));
}

TEST(RequireContrast, passesAFlatTargetBesideWhichSomethingIs) {
  cv::Mat1b image(80, 100, static_cast<uchar>(3));
  image(40, 57) = 200;
  EXPECT_EQ("", refusalOf([&] { requireContrast(image, box(30, 30, 19, 19)); }));
}

TEST(RequireContrast, refusesWhereNothingIsToBeSeen) {
  cv::Mat1b image(80, 100, static_cast<uchar>(3));
  image(5, 5) = 200;
  image(40, 40) = 10;
  EXPECT_EQ("", omissionsOf(refusalOf([&] { requireContrast(image, box(30, 30, 19, 19)); }),
                            {"differ by 7", "at least 8"}));
  image(40, 40) = 11;
  EXPECT_EQ("", refusalOf([&] { requireContrast(image, box(30, 30, 19, 19)); }));
}

}  // namespace
}  // namespace chain_tracker
