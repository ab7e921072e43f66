// SPDX-License-Identifier: BSD-3-Clause
/// Several trackers over the same frames in order, none dropped, each frame decoded once.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "chain_tracker/evaluation/evaluated_tracker.h"
#include "chain_tracker/evaluation/frame_source.h"
#include "chain_tracker/evaluation/ground_truth.h"
#include "chain_tracker/evaluation/metrics.h"

namespace chain_tracker {

/// What a tracker reported of a frame, and what that is worth.
struct EvaluatedFrame {
  int index = 0;          ///< in the source's order
  double time_ms = 0.0;   ///< of the update; of the initialisation in the first frame
  bool was_asked = true;  ///< false once the tracker has failed
  TrackedFrame tracked;
  FrameScore score;
};

struct TrackerRun {
  std::string name;
  std::vector<EvaluatedFrame> frames;
  Scores scores;
  std::string fault;  ///< why the tracker failed; empty if it did not
};

/// What a tracker reported of a frame when it ran elsewhere.
struct RecordedFrame {
  double time_ms = 0.0;
  TrackedFrame tracked;
};

struct EvaluationOptions {
  int first_frame = 0;                      ///< where the object is given
  int max_frames = 0;                       ///< 0: all
  std::function<bool()> interrupted;        ///< asked before every frame; true ends the run
  std::function<void(int frame)> progress;  ///< after every frame
  /// Sees every frame with the chain tracker's result, for pictures; may be empty.
  std::function<void(const SourceFrame&, const TrackedFrame&)> observer;
};

struct EvaluationResult {
  std::vector<TrackerRun> runs;     ///< in the order of the trackers
  std::vector<std::string> faults;  ///< of frames, trackers and the truth, one line each
  int skipped_frames = 0;           ///< could not be read or had another size than the first
  int dropped_frames = 0;           ///< of a recording: could be read, but nothing was reported
  bool interrupted = false;
};

/// Runs the trackers, the first of which is the chain tracker, and scores each frame.
/// `start`: the shape that initialised them, whose length the PCK refers to.
/// Where the truth has points but no boxes, boxes are the upright bounds of the visible points
/// grown by 10 %, for the truth and for the carried points alike. Point k is scored with part k:
/// where they differ in number, only boxes are scored, and that is told among the faults.
/// A tracker that fails on a frame has lost the object from there on; its fault is told.
/// Throws std::invalid_argument if the frame that the object is given in cannot be read or does not
/// exist, or if the chain tracker cannot be started there.
EvaluationResult evaluate(FrameSource& frames,
                          const std::vector<std::unique_ptr<EvaluatedTracker>>& trackers,
                          const GroundTruth& truth, const std::vector<cv::Point2d>& start,
                          const EvaluationOptions& options);

/// Scores what a chain tracker reported of some of the frames, by their index, when it ran
/// elsewhere. Times of the frames are the recorded ones. Throws as evaluate() does.
EvaluationResult scoreRecording(FrameSource& frames, const std::map<int, RecordedFrame>& recording,
                                const GroundTruth& truth, const std::vector<cv::Point2d>& start,
                                const EvaluationOptions& options);

/// Upright bounds of points grown by 10 % of their size, at least a pixel wide: the box that stands
/// for a shape known by its points only.
cv::Rect2d boxAround(const std::vector<cv::Point2d>& points);

/// The upright box of what was tracked that compares with the truth's: a box given by upright
/// corners does not turn with the object, where the truth does turn the bounds of its outline stand
/// for it.
cv::Rect2d comparableBox(const TrackedFrame& tracked, const GroundTruth& truth);

/// Scores what was tracked in a frame. Pure; serves live recordings too.
FrameScore scoreFrame(const TrackedFrame& tracked, const GroundTruth& truth, int frame);

/// Length of the shape that PCK refers to: of the polyline, or the diagonal of a rectangle [px].
double objectLength(const std::vector<cv::Point2d>& start, bool rectangle);

}  // namespace chain_tracker
