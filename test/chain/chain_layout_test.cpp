// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/chain_layout.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

ChainModel modelOf(Layout layout, int parts) {
  ChainModel model;
  model.segments[0].name = "seg";
  model.segments[0].layout = layout;
  model.segments[0].parts = parts;
  model.segments[0].margin = 0.0;
  return model;
}

/// Corners of a turned rectangle, in order.
std::vector<cv::Point2d> rectangle(const cv::Point2d& center, double length, double width,
                                   double angle) {
  const Similarity turn{angle, 1.0, center};
  return {turn.apply({-length / 2, -width / 2}), turn.apply({length / 2, -width / 2}),
          turn.apply({length / 2, width / 2}), turn.apply({-length / 2, width / 2})};
}

SegmentLayout layOutOne(const ChainModel& model, const std::vector<cv::Point2d>& points) {
  const ChainLayout layout = layOut(model, points);
  EXPECT_EQ(1U, layout.segments.size());
  return layout.segments.front();
}

double lengthOf(const SegmentLayout& segment) {
  return cv::norm(segment.corners[1] - segment.corners[0]);
}
double widthOf(const SegmentLayout& segment) {
  return cv::norm(segment.corners[3] - segment.corners[0]);
}

/// The grid of cells, read off the parts' positions.
struct Cells {
  int columns = 0;
  int rows = 0;
  double width = 0.0;
  double height = 0.0;

  explicit Cells(const SegmentLayout& segment) {
    std::set<long> xs;
    std::set<long> ys;
    for (const PartLayout& part : segment.parts) {
      xs.insert(std::lround(part.position.x * 1e6));
      ys.insert(std::lround(part.position.y * 1e6));
    }
    columns = static_cast<int>(xs.size());
    rows = static_cast<int>(ys.size());
    width = lengthOf(segment) / columns;
    height = widthOf(segment) / rows;
  }
};

void expectNear(const cv::Point2d& expected, const cv::Point2d& actual) {
  EXPECT_NEAR(expected.x, actual.x, 1e-6);
  EXPECT_NEAR(expected.y, actual.y, 1e-6);
}

/// Every cell has its part; neighbours in the chain are neighbours in the grid.
void expectSerpentineOverTheRectangle(const SegmentLayout& segment) {
  const Cells cells(segment);
  ASSERT_EQ(static_cast<size_t>(cells.columns * cells.rows), segment.parts.size());
  std::set<std::pair<int, int>> visited;
  std::pair<int, int> previous;
  for (size_t k = 0; k < segment.parts.size(); ++k) {
    const cv::Point2d in_cells((segment.parts[k].position.x + lengthOf(segment) / 2) / cells.width,
                               (segment.parts[k].position.y + widthOf(segment) / 2) / cells.height);
    const std::pair<int, int> cell(static_cast<int>(in_cells.x), static_cast<int>(in_cells.y));
    expectNear({cell.first + 0.5, cell.second + 0.5}, in_cells);
    EXPECT_TRUE(cell.first >= 0 && cell.first < cells.columns) << "part " << k;
    EXPECT_TRUE(cell.second >= 0 && cell.second < cells.rows) << "part " << k;
    EXPECT_TRUE(visited.insert(cell).second) << "part " << k << " shares its cell";
    if (k > 0) {
      const int steps =
          std::abs(cell.first - previous.first) + std::abs(cell.second - previous.second);
      EXPECT_EQ(1, steps) << "from part " << k - 1;
    }
    previous = cell;
  }
}

TEST(LayOut, cellsCoverTheRectangleInASerpentine) {
  for (int parts : {2, 3, 5, 6, 12, 24, 60, 200}) {
    for (double aspect : {0.02, 0.1, 0.4, 0.75, 1.0}) {
      SCOPED_TRACE(std::to_string(parts) + " parts, aspect " + std::to_string(aspect));
      expectSerpentineOverTheRectangle(layOutOne(
          modelOf(Layout::kPlanar, parts), rectangle({200, 150}, 120.0, 120.0 * aspect, 0.3)));
    }
  }
}

TEST(LayOut, cellsAreAsManyAndAsSquareAsTheyCan) {
  for (int rows : {1, 2, 3, 4}) {
    for (int columns : {2, 3, 4, 6}) {
      const SegmentLayout segment =
          layOutOne(modelOf(Layout::kPlanar, rows * columns),
                    rectangle({200, 150}, 20.0 * columns, 20.0 * rows, -0.4));
      const Cells cells(segment);
      EXPECT_EQ(columns, cells.columns);
      EXPECT_EQ(rows, cells.rows);
    }
  }
}

TEST(LayOut, numberOfCellsComesNearTheOneWanted) {
  for (int parts = 2; parts <= 200; ++parts) {
    for (double aspect : {0.01, 0.3, 0.5, 1.0}) {
      const SegmentLayout segment =
          layOutOne(modelOf(Layout::kPlanar, parts), rectangle({0, 0}, 500.0, 500.0 * aspect, 0.0));
      const double ratio = double(segment.parts.size()) / parts;
      EXPECT_TRUE(ratio > 0.65 && ratio < 1.5)
          << segment.parts.size() << " for " << parts << " at aspect " << aspect;
    }
  }
}

TEST(LayOut, windowsAreAMultipleOfTheCells) {
  ChainModel model = modelOf(Layout::kPlanar, 6);
  model.segments[0].window = 1.5;
  for (const PartLayout& part : layOutOne(model, rectangle({0, 0}, 90.0, 60.0, 0.2)).parts) {
    EXPECT_NEAR(45.0, part.side, 1e-9);
  }
}

TEST(LayOut, fourCornersMayStartAnywhereAndRunEitherWay) {
  for (Layout kind : {Layout::kPlanar, Layout::kElongated}) {
    for (double angle : {0.0, 0.7, 2.0, -2.9, CV_PI}) {
      std::vector<cv::Point2d> corners = rectangle({300, 200}, 100.0, 40.0, angle);
      for (int order = 0; order < 8; ++order) {
        SCOPED_TRACE("angle " + std::to_string(angle) + ", order " + std::to_string(order));
        const SegmentLayout segment = layOutOne(modelOf(kind, 24), corners);
        expectNear({300, 200}, segment.image_from_segment.translation);
        EXPECT_EQ(1.0, segment.image_from_segment.scale);
        expectSerpentineOverTheRectangle(segment);
        for (const cv::Point2d& corner : corners) {
          const auto same = [&](const cv::Point2d& laid) {
            return cv::norm(segment.image_from_segment.apply(laid) - corner) < 1e-6;
          };
          EXPECT_EQ(1, std::count_if(segment.corners.begin(), segment.corners.end(), same));
        }
        for (size_t i = 0; i < 4; ++i) {
          expectNear(corners[i], segment.image_from_segment.apply(segment.points[i]));
        }
        std::rotate(corners.begin(), corners.begin() + 1, corners.end());
        if (order == 3) std::reverse(corners.begin(), corners.end());
      }
    }
  }
}

TEST(LayOut, elongatedSegmentsPointAlongTheirLongSide) {
  std::vector<cv::Point2d> corners = rectangle({300, 200}, 100.0, 40.0, 0.7);
  for (int start = 0; start < 4; ++start) {
    const SegmentLayout segment = layOutOne(modelOf(Layout::kElongated, 24), corners);
    EXPECT_NEAR(0.0, std::sin(segment.image_from_segment.angle - 0.7), 1e-9) << "start " << start;
    EXPECT_NEAR(100.0, lengthOf(segment), 1e-9);
    EXPECT_NEAR(40.0, widthOf(segment), 1e-9);
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
  }
}

TEST(LayOut, planarSegmentsPointAlongTheFirstSide) {
  const SegmentLayout segment =
      layOutOne(modelOf(Layout::kPlanar, 24), rectangle({300, 200}, 40.0, 100.0, 0.7));
  EXPECT_NEAR(0.7, segment.image_from_segment.angle, 1e-9);
  EXPECT_NEAR(40.0, lengthOf(segment), 1e-9);
  EXPECT_NEAR(100.0, widthOf(segment), 1e-9);
}

TEST(LayOut, twoEndsAndAspectMakeARectangle) {
  ChainModel model = modelOf(Layout::kElongated, 24);
  model.segments[0].aspect = 0.25;
  const SegmentLayout segment = layOutOne(model, {{100, 50}, {160, 130}});
  expectNear({130, 90}, segment.image_from_segment.translation);
  EXPECT_NEAR(std::atan2(80, 60), segment.image_from_segment.angle, 1e-9);
  EXPECT_NEAR(100.0, lengthOf(segment), 1e-9);
  EXPECT_NEAR(25.0, widthOf(segment), 1e-9);
  expectNear({-50, 0}, segment.points[0]);
  expectNear({50, 0}, segment.points[1]);
  expectSerpentineOverTheRectangle(segment);
}

TEST(LayOut, deformablePartsFollowThePolylineInEqualSteps) {
  const std::vector<cv::Point2d> polyline = {{10, 10}, {110, 10}, {110, 40}, {60, 90}};
  const double length = 130.0 + std::sqrt(5000.0);
  for (int parts : {2, 3, 7, 12, 50}) {
    SCOPED_TRACE(std::to_string(parts) + " parts");
    const SegmentLayout segment = layOutOne(modelOf(Layout::kDeformable, parts), polyline);
    ASSERT_EQ(static_cast<size_t>(parts), segment.parts.size());
    for (int k = 0; k < parts; ++k) {
      // The point of the polyline at this length along it.
      double rest = length * k / (parts - 1);
      size_t i = 0;
      while (i + 2 < polyline.size() && rest > cv::norm(polyline[i + 1] - polyline[i])) {
        rest -= cv::norm(polyline[i + 1] - polyline[i]);
        ++i;
      }
      const cv::Point2d edge = polyline[i + 1] - polyline[i];
      const PartLayout& part = segment.parts[static_cast<size_t>(k)];
      expectNear(polyline[i] + edge * (rest / cv::norm(edge)),
                 segment.image_from_segment.apply(part.position));
      EXPECT_NEAR(1.15 * length / (parts - 1), part.side, 1e-9);
    }
  }
}

TEST(LayOut, pointsAreParts) {
  const std::vector<cv::Point2d> points = {{10, 10}, {50, 40}, {20, 60}, {-20, 30}};
  ChainModel model = modelOf(Layout::kPoints, 24);
  model.segments[0].window = 0.6;
  const ChainLayout layout = layOut(model, points);
  const SegmentLayout& segment = layout.segments[0];
  ASSERT_EQ(points.size(), segment.parts.size());
  double length = 0.0;
  for (size_t k = 0; k < points.size(); ++k) {
    expectNear(points[k], segment.image_from_segment.apply(segment.parts[k].position));
    if (k > 0) length += cv::norm(points[k] - points[k - 1]);
  }
  for (const PartLayout& part : segment.parts) EXPECT_NEAR(0.6 * length / 3.0, part.side, 1e-9);
  EXPECT_EQ(points, layout.silhouette.points);
  EXPECT_NEAR(segment.parts.front().side, layout.silhouette.stroke, 1e-9);
}

TEST(LayOut, edgesLeadFromEachPartToTheNext) {
  ChainModel model = modelOf(Layout::kDeformable, 9);
  model.segments[0].stretch_sigma = 0.07;
  model.segments[0].bend_sigma = 0.3;
  const SegmentLayout segment = layOutOne(model, {{10, 10}, {110, 10}, {110, 90}});
  ASSERT_EQ(8U, segment.edges.size());
  for (size_t k = 0; k < segment.edges.size(); ++k) {
    const EdgeLayout& edge = segment.edges[k];
    const cv::Point2d vector(edge.length * std::cos(edge.direction),
                             edge.length * std::sin(edge.direction));
    expectNear(segment.parts[k + 1].position, segment.parts[k].position + vector);
    EXPECT_EQ(0.07, edge.stretch_sigma);
    EXPECT_EQ(0.3, edge.bend_sigma);
  }
}

TEST(LayOut, keepsNameAndKind) {
  const SegmentLayout segment = layOutOne(modelOf(Layout::kDeformable, 5), {{0, 0}, {50, 0}});
  EXPECT_EQ("seg", segment.name);
  EXPECT_EQ(Layout::kDeformable, segment.layout);
}

}  // namespace
}  // namespace chain_tracker
