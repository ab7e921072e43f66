// SPDX-License-Identifier: BSD-3-Clause
/// Figures of merit as the tracking benchmarks define them.
///
/// OTB: Wu, Lim and Yang, "Online Object Tracking: A Benchmark", CVPR 2013 (one-pass evaluation,
/// the first frame included). PASCAL score: Santner et al., "PROST", CVPR 2010. PCK: Yang and
/// Ramanan, "Articulated Human Detection with Flexible Mixtures of Parts", PAMI 2013.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace chain_tracker {

/// Intersection over union of two boxes, in [0, 1]; 0 if either is empty.
double intersectionOverUnion(const cv::Rect2d& a, const cv::Rect2d& b);

/// Distance of the centres [px].
double centerDistance(const cv::Rect2d& a, const cv::Rect2d& b);

/// Share of overlaps above each of the 21 thresholds 0, 0.05, ..., 1 (OTB's success plot).
std::vector<double> successCurve(const std::vector<double>& overlaps);

/// Area under the success curve: the mean of its 21 values (OTB's success score).
double successAuc(const std::vector<double>& overlaps);

double mean(const std::vector<double>& values);  ///< NaN if there are none

/// The value below which a share `p` in [0, 1] of the values lies, linearly interpolated between
/// order statistics; NaN if there are none.
double percentile(std::vector<double> values, double p);

/// Share of the values at most `limit`; NaN if there are none.
double shareWithin(const std::vector<double>& values, double limit);

/// What a frame counts for. A frame without truth does not count at all.
struct FrameScore {
  bool has_object = false;           ///< the truth says where the object is
  bool lost = false;                 ///< the tracker reports that it does not know
  double overlap = 0.0;              ///< 0 for a lost frame
  double center_error = 0.0;         ///< [px]; infinite for a lost frame
  std::vector<double> point_errors;  ///< of visible true points [px]; infinite for a lost frame
  int hidden_points = 0;             ///< true points that are not visible
};

/// Scores of a tracker on a sequence, the columns of every table.
struct Scores {
  int frames = 0;         ///< processed
  int scored_frames = 0;  ///< with an object in the truth
  double mean_iou = 0.0;
  double success_auc = 0.0;
  double pascal_50 = 0.0;             ///< share of frames with IoU > 0.5
  double precision_20px = 0.0;        ///< share of frames with the centre within 20 px
  double mean_center_error_px = 0.0;  ///< over the frames not lost
  double part_error_mean_px = 0.0;    ///< over the points of frames not lost; NaN without points
  double part_error_median_px = 0.0;
  double part_error_p95_px = 0.0;
  double pck_10 = 0.0;  ///< share of visible points within 10 % of the object's length
  int lost_frames = 0;  ///< lost although the object was there
  int reacquired = 0;   ///< times a lost object was found again with IoU > 0
  int occlusions = 0;   ///< times more than a third of the points were hidden and came out again
  int occlusions_recovered = 0;  ///< of these, with the object found within 10 frames
  double fps = 0.0;
  double latency_p50_ms = 0.0;
  double latency_p99_ms = 0.0;
};

/// `object_length` [px]: of the initial shape, for PCK; `times_ms`: of the updates, the
/// initialisation not included.
Scores summarize(const std::vector<FrameScore>& frames, double object_length,
                 const std::vector<double>& times_ms);

}  // namespace chain_tracker
