// SPDX-License-Identifier: BSD-3-Clause
/// What is known about a sequence: boxes, material points, and how to start.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace chain_tracker {

/// A material point of the object; point k is vertex k of the initial shape.
struct TruePoint {
  cv::Point2d position;  ///< [px]
  bool visible = true;
};

struct GroundTruth {
  /// Upright boxes by frame; a frame without an entry has no truth, nullopt says: no object.
  std::map<int, std::optional<cv::Rect2d>> boxes;
  /// Corners, in order, of the boxes that were given by them, by frame.
  std::map<int, std::vector<cv::Point2d>> polygons;
  /// Some of these corners are not those of an upright box: the boxes turn with the object, and the
  /// upright ones bound them.
  bool boxes_turn = false;
  /// Points by frame and index; frames and points may be missing.
  std::map<int, std::map<int, TruePoint>> points;

  bool empty() const { return boxes.empty() && points.empty(); }
};

/// Parts that the truth tells of, 0 to this - 1, whether or not each is there in every frame.
std::size_t partCount(const GroundTruth& truth);

/// How a sequence wants to be started (its init.yaml, or its first truth).
struct SequenceStart {
  std::string model = "auto";
  std::vector<cv::Point2d> points;
  int first_frame = 0;
};

/// Reads `groundtruth_rect.txt`: a line a frame, x,y,w,h or four corners x1,y1,...,x4,y4 separated
/// by commas, tabs or spaces; NaN: no object.
/// Throws std::invalid_argument naming file, line and what is wrong with it.
void readBoxes(const std::string& path, GroundTruth& truth);

/// Reads `groundtruth_parts.csv`: `frame,part,x,y,visible` below that header. Errors as above; a
/// point with NaN is taken for missing.
void readPoints(const std::string& path, GroundTruth& truth);

/// The truth in a sequence folder, from either file or both; empty if it has none.
GroundTruth readGroundTruth(const std::string& folder);

/// From the folder's init.yaml, if there is a folder with one. Points that it leaves out are those
/// of the truth: all parts, or the box of a truth without parts, in its first_frame or, without
/// one, in the first frame with them. nullopt if there are none. Throws std::invalid_argument for a
/// faulty init.yaml, also if the truth does not know the object in its first_frame.
std::optional<SequenceStart> readStart(const std::string& folder, const GroundTruth& truth);

}  // namespace chain_tracker
