// SPDX-License-Identifier: BSD-3-Clause
/// The objects of one nodelet: started, tracked through the frames, started again, removed.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>
#include <ros/time.h>

#include "chain_tracker/TrackedObject.h"
#include "chain_tracker/chain/chain_tracker.h"
#include "chain_tracker/ros/frame_mailbox.h"
#include "chain_tracker/ros/image_history.h"
#include "chain_tracker/ros/target_request.h"

namespace chain_tracker {

/// What one frame brought.
struct FrameResult {
  std::vector<TrackedObject> objects;  ///< in alphabetical order of id
  struct Fault {
    std::string id;      ///< of the object
    std::string reason;  ///< one sentence
  };
  std::vector<Fault> faults;
  std::vector<std::string> notes;  ///< what was started again and why, one sentence each
};

/// Thread-safe: the worker calls process(), services call the rest at any time.
class TargetRegistry {
 public:
  /// Told once how a start went: the reason for refusing it, or nothing if the object is tracked
  /// now. Must not call the registry.
  using Answer = std::function<void(const std::string& refusal)>;

  /// In [1, 256]: objects that are tracked at once, or threads that share the work of a single one.
  /// Not to be called while process() runs.
  void useThreads(int threads) { threads_ = threads; }

  /// Starts an object on the next frame that shows anything where it is to be. If that succeeds,
  /// one of the same id is replaced, and one that was asked for earlier and still waits is refused.
  /// Returns a ticket for withdraw().
  std::uint64_t startAtNextFrame(const TargetRequest& request, const ChainModel& model,
                                 Answer answer);

  /// Takes a start back that waits for its frame. Returns why the frames so far did not do, which
  /// is empty if there were none; nothing if the start was answered already.
  std::optional<std::string> withdraw(std::uint64_t ticket);

  /// Starts an object on a frame of the past and tracks it through the later ones in the history.
  /// Throws std::invalid_argument with the reason; then all is as before.
  void startAt(const Frame& frame, const TargetRequest& request, const ChainModel& model,
               const ImageHistory& history);

  /// Also one that waits to start. False if there is no such object.
  bool remove(const std::string& id);

  /// Starts all objects again on the next frame, from the points given; returns their number.
  std::size_t restartAll();

  /// Refuses all objects that wait or come later.
  void close();

  /// Tracks all objects into the next frame; `image` are its pixels (CV_8UC3 BGR).
  ///
  /// An object is started again from the points given if restartAll() was called or the stamp lies
  /// more than half a second before the last one (a bag that starts again); from where it is now,
  /// scaled, if the image's size has changed, with fewer parts where there is no room for all of
  /// the model's. An object that cannot be started again is LOST, and
  /// tried again with every frame. One object's fault does not touch the others, and nothing is
  /// thrown.
  FrameResult process(const Frame& frame, const cv::Mat& image);

 private:
  struct Target {
    std::vector<cv::Point2d> given_points;  ///< [px] of images of size image_size
    ChainModel given_model;                 ///< for images of size given_size
    cv::Size given_size;
    cv::Size image_size;
    ChainTracker tracker;
    std::uint64_t frame_number;  ///< of the last frame it has seen
    ros::Time stamp;             ///< of that frame
    bool restart = false;        ///< on the next frame
  };
  struct Waiting {
    std::uint64_t ticket;
    TargetRequest request;
    ChainModel model;
    Answer answer;
    std::string reason;  ///< why it still waits
  };

  static Target start(const Frame& frame, const cv::Mat& image,
                      const std::vector<cv::Point2d>& points, const ChainModel& model);
  /// Starts the object anew, as the one that was given once.
  static void startAgain(const Frame& frame, const cv::Mat& image,
                         const std::vector<cv::Point2d>& points, const ChainModel& model,
                         Target* target);
  static void catchUp(const ImageHistory& history, std::uint64_t up_to, Target* target);
  /// Why the frame does not follow the last one the target has seen; empty if it does.
  static std::string breakInStream(const Frame& frame, const cv::Mat& image, const Target& target);
  static void advance(const Frame& frame, const cv::Mat& image, Target* target);
  static void advanceAndTell(const Frame& frame, const cv::Mat& image, const std::string& id,
                             Target* target, FrameResult* result);
  void advanceAll(const Frame& frame, const cv::Mat& image, FrameResult* result);
  /// Answers all that wait under this id and takes them out; false if there are none.
  static bool refuseWaiting(const std::string& id, const std::string& reason,
                            std::vector<Waiting>* waiting);
  /// False if the frame shows nothing there; else those of `earlier`, which still wait, are refused
  /// that have the same id.
  bool tryToStart(const Frame& frame, const cv::Mat& image, Waiting& waiting,
                  std::vector<Waiting>* earlier);
  void startWaiting(const Frame& frame, const cv::Mat& image, FrameResult* result);

  int threads_ = 1;
  std::mutex mutex_;
  std::map<std::string, Target> targets_;
  std::vector<Waiting> waiting_;
  std::uint64_t last_ticket_ = 0;
  std::uint64_t last_frame_ = 0;  ///< number of the last frame processed
  bool closed_ = false;
};

}  // namespace chain_tracker
