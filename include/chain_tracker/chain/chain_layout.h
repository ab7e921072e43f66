// SPDX-License-Identifier: BSD-3-Clause
/// A model laid over a shape: reference positions, windows and edges of the parts (thesis ch. 3.2.2
/// and 3.4.1).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_model.h"
#include "chain_tracker/image/pixel_geometry.h"

namespace chain_tracker {

struct PartLayout {
  cv::Point2d position;  ///< in the segment's frame, at scale 1 [px]
  double side = 0.0;     ///< of the window at scale 1 [px]
};

/// Edge from a node to the next one: the thesis's distance d and angular displacement phi.
struct EdgeLayout {
  double length = 0.0;         ///< at scale 1 [px]
  double direction = 0.0;      ///< against the segment's orientation [rad]
  double stretch_sigma = 0.0;  ///< of the length, fraction of the length
  double bend_sigma = 0.0;     ///< of the direction [rad]
};

/// The nodes of a segment's chain are the joint where it begins, its parts, and the joint where it
/// ends; the first and the last segment have no joint at their free ends.
struct SegmentLayout {
  std::string name;
  Layout layout = Layout::kElongated;
  Similarity image_from_segment;  ///< in the first frame; its scale is 1
  std::vector<PartLayout> parts;
  std::optional<cv::Point2d> entry;  ///< joint with the segment before, in the segment's frame
  std::optional<cv::Point2d> exit;   ///< joint with the segment behind, in the segment's frame
  std::vector<EdgeLayout> edges;     ///< between neighbouring nodes: one fewer than nodes
  std::vector<cv::Point2d> points;   ///< those given, in the segment's frame
  std::vector<cv::Point2d> corners;  ///< of the initial box, in the segment's frame
};

/// Positions of all nodes, in the segment's frame.
std::vector<cv::Point2d> nodesOf(const SegmentLayout& segment);

/// Of its chain, from end to end along the edges [px].
double chainLengthOf(const SegmentLayout& segment);

/// The region that the object covers in the first frame [px].
struct Silhouette {
  std::vector<cv::Point2d> points;
  double stroke = 0.0;  ///< width of the open polyline; 0: a closed polygon, filled
};

struct ChainLayout {
  std::vector<SegmentLayout> segments;
  Silhouette silhouette;
};

/// A chain of several segments takes the polyline of its joints: one point more than segments, from
/// the free end of the first to that of the last.
/// Throws std::invalid_argument if the layout cannot take that many points or if points are not
/// finite, coincide or span no area, naming them.
ChainLayout layOut(const ChainModel& model, const std::vector<cv::Point2d>& points);

/// Of the pixels of `region`: 255 where the silhouette, grown by `margin` [px] on all sides, covers
/// one.
cv::Mat1b maskOf(const Silhouette& silhouette, const cv::Rect& region, double margin);

}  // namespace chain_tracker
