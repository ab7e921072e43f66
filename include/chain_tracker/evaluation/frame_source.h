// SPDX-License-Identifier: BSD-3-Clause
/// Frames in order, wherever they come from.
#pragma once

#include <memory>
#include <string>

#include <opencv2/core.hpp>

namespace chain_tracker {

struct SourceFrame {
  int index = 0;  ///< from 0, in the source's order; unreadable frames count
  double time_sec = 0.0;
  cv::Mat image;      ///< CV_8UC3 or CV_8UC1; empty if the frame cannot be read
  std::string fault;  ///< why it cannot be read; empty if it can
};

class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// The next frame; false after the last one. Every frame is delivered, none is dropped; one that
  /// cannot be read is delivered without an image.
  virtual bool next(SourceFrame& frame) = 0;

  /// Number of frames, or 0 if only reading on will tell.
  virtual int count() const = 0;

  /// Frames a second, or 0 if it is not known or not constant.
  virtual double rate() const { return 0.0; }

  /// Asked after the last frame: a sentence if fewer came than the source promises, else empty.
  virtual std::string shortfall() const { return ""; }
};

/// The frames of a sequence folder (img/*.jpg, *.png or *.bmp in natural order of their
/// names, 2.png before 10.png, or one *.mp4 or *.avi file) or of a video file. Times are the index
/// over 30 for pictures and over the video's rate. Throws std::invalid_argument naming the path if
/// there are no frames.
std::unique_ptr<FrameSource> openFrames(const std::string& path);

/// The same frames as a mono8 camera would deliver them: CV_8UC1.
std::unique_ptr<FrameSource> greyFrames(std::unique_ptr<FrameSource> frames);

}  // namespace chain_tracker
