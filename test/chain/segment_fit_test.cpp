// SPDX-License-Identifier: BSD-3-Clause
#include "chain/segment_fit.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "chain_tracker/chain/chain_model.h"

namespace chain_tracker {
namespace {

/// Hypotheses 0.1 rad and 4 % apart around no turn and scale 1.
const PoseGrid kPoses{{0.0, 1.0}, 3, 0.1, 3, 0.04};

SegmentLayout planarSegment() {
  ChainModel model;
  model.segments[0].layout = Layout::kPlanar;
  return layOut(model, {{0.0, 0.0}, {80.0, 0.0}, {80.0, 60.0}, {0.0, 60.0}}).segments.front();
}

SegmentLayout deformableSegment() {
  ChainModel model;
  model.segments[0].layout = Layout::kDeformable;
  return layOut(model, {{0.0, 0.0}, {200.0, 0.0}}).segments.front();
}

/// The parts where the pose puts them.
std::vector<PartState> partsAt(const SegmentLayout& segment, const Similarity& pose) {
  std::vector<PartState> parts;
  for (const PartLayout& layout : segment.parts) {
    PartState part;
    part.position = pose.apply(layout.position);
    part.confidence = 0.8;
    parts.push_back(part);
  }
  return parts;
}

Similarity fitted(const SegmentLayout& segment, const PoseGrid& poses,
                  const std::vector<PartState>& parts, double length_rate = 1.0) {
  SegmentFitWorkspace workspace;
  return fitSegment(segment, poses, parts, length_rate, workspace);
}

void expectNear(const Similarity& expected, const Similarity& actual, double tolerance = 1e-6) {
  EXPECT_NEAR(expected.angle, actual.angle, tolerance);
  EXPECT_NEAR(expected.scale, actual.scale, tolerance);
  EXPECT_LT(cv::norm(expected.translation - actual.translation), 100.0 * tolerance);
}

TEST(FitSegment, isExactWithinHalfAStep) {
  const SegmentLayout segment = planarSegment();
  const Similarity pose{-0.03, 1.015, {123.0, 45.0}};
  expectNear(pose, fitted(segment, kPoses, partsAt(segment, pose)));
}

TEST(FitSegment, stopsAtHalfAStep) {
  const SegmentLayout segment = planarSegment();
  const Similarity fit = fitted(segment, kPoses, partsAt(segment, {0.3, 0.8, {123.0, 45.0}}));
  EXPECT_NEAR(0.05, fit.angle, 1e-9);
  EXPECT_NEAR(std::exp(-0.02), fit.scale, 1e-9);
}

TEST(FitSegment, heedsTheBulkOfTheParts) {
  const SegmentLayout segment = planarSegment();
  const Similarity pose{0.02, 0.99, {123.0, 45.0}};
  std::vector<PartState> parts = partsAt(segment, pose);
  parts[0].position += cv::Point2d(40.0, 10.0);
  parts[1].position += cv::Point2d(35.0, 10.0);
  expectNear(pose, fitted(segment, kPoses, parts), 0.01);
}

TEST(FitSegment, heedsPartsByTheirConfidence) {
  const SegmentLayout segment = deformableSegment();
  std::vector<PartState> parts = partsAt(segment, {0.0, 1.0, {}});
  for (PartState& part : parts) part.position.y += 4.0;
  for (size_t k = 0; k < parts.size() / 2; ++k) {
    parts[k].confidence = 0.0;
    parts[k].position.y += 6.0;
  }
  EXPECT_NEAR(4.0, fitted(segment, kPoses, parts).apply(segment.parts.back().position).y, 0.1);
}

TEST(FitSegment, isDefinedWhereNoPartIsSure) {
  const SegmentLayout segment = planarSegment();
  const Similarity pose{0.01, 1.0, {20.0, 30.0}};
  std::vector<PartState> parts = partsAt(segment, pose);
  for (PartState& part : parts) part.confidence = 0.0;
  expectNear(pose, fitted(segment, kPoses, parts));
}

/// A single scale is searched; the parts lie `scale` as far apart, with that variance [px^2].
double scaleOfParts(double scale, double variance) {
  const SegmentLayout segment = planarSegment();
  const PoseGrid poses{{0.0, scale}, 3, 0.1, 1, 0.5};
  std::vector<PartState> parts = partsAt(segment, {0.0, scale, {123.0, 45.0}});
  for (PartState& part : parts) part.covariance = variance * cv::Matx22d::eye();
  return fitted(segment, poses, parts).scale;
}

TEST(FitSegment, keepsTheScaleThatThePartsTell) {
  EXPECT_NEAR(1.2, scaleOfParts(1.2, 0.5), 1e-3);
  EXPECT_NEAR(0.8, scaleOfParts(0.8, 0.5), 1e-3);
}

TEST(FitSegment, returnsToTheFirstScaleWhereThePartsTellNone) {
  EXPECT_NEAR(1.0, scaleOfParts(1.2, 1e7), 1e-3);
  EXPECT_NEAR(1.0, scaleOfParts(0.8, 1e7), 1e-3);
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(1.0, scaleOfParts(0.8, unknown));
}

/// Half of what is known comes from the parts if their information is that of the first frame.
TEST(FitSegment, weighsThePartsByWhatTheyTell) {
  const SegmentLayout segment = planarSegment();
  const double scale = 1.21;
  double squares = 0.0;
  for (const PartLayout& part : segment.parts) squares += part.position.dot(part.position);
  const double variance = 0.8 * scale * scale * squares * 0.2 * 0.2;
  EXPECT_NEAR(1.1, scaleOfParts(scale, variance), 1e-6);
}

TEST(FitSegment, leavesTheScaleToTheSearchThatTriesSeveral) {
  const SegmentLayout segment = planarSegment();
  const Similarity pose{0.0, 1.01, {123.0, 45.0}};
  std::vector<PartState> parts = partsAt(segment, pose);
  for (PartState& part : parts) part.covariance = 1e7 * cv::Matx22d::eye();
  expectNear(pose, fitted(segment, kPoses, parts));
}

TEST(FitSegment, whatCoilsUpKeepsItsScale) {
  const SegmentLayout segment = deformableSegment();
  std::vector<PartState> parts = partsAt(segment, {0.0, 1.0, {}});
  const double step = cv::norm(segment.parts[1].position - segment.parts[0].position);
  for (size_t k = 1; k < parts.size(); ++k) {
    const double direction = 0.1 * static_cast<double>(k);
    parts[k].position =
        parts[k - 1].position + step * cv::Point2d(std::cos(direction), std::sin(direction));
  }
  EXPECT_NEAR(1.0, fitted(segment, kPoses, parts).scale, 1e-6);
}

TEST(FitSegment, followsTheShareOfALengthThatIsTold) {
  const SegmentLayout segment = deformableSegment();
  const std::vector<PartState> parts = partsAt(segment, {0.0, 0.99, {}});
  EXPECT_NEAR(0.99, fitted(segment, kPoses, parts, 1.0).scale, 1e-9);
  EXPECT_NEAR(std::sqrt(0.99), fitted(segment, kPoses, parts, 0.5).scale, 1e-9);
  EXPECT_EQ(1.0, fitted(segment, kPoses, parts, 0.0).scale);
}

/// As two parts of a line that doubles back to where it began.
TEST(FitSegment, keepsTheScaleOfPartsThatCoincide) {
  SegmentLayout segment = deformableSegment();
  segment.parts.resize(2);
  segment.parts[1] = segment.parts[0];
  const Similarity pose{0.0, 1.0, {50.0, 50.0}};
  EXPECT_EQ(1.0, fitted(segment, kPoses, partsAt(segment, pose)).scale);
}

}  // namespace
}  // namespace chain_tracker
