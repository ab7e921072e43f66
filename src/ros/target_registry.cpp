// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/ros/target_registry.h"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "chain_tracker/chain/auto_model.h"
#include "chain_tracker/chain/target_checks.h"
#include "chain_tracker/ros/image_conversion.h"
#include "chain_tracker/ros/msg_conversion.h"
#include "chain_tracker/ros/stamp_order.h"

namespace chain_tracker {
namespace {

constexpr char kClosed[] = "the tracker is being shut down";
constexpr char kReplaced[] = "it has been started otherwise meanwhile";
constexpr char kRemoved[] = "it has been removed";

/// The points of an image of size `from`, in the same image at size `to`. Pixel centres lie on
/// whole numbers, so the images share the corner (-0.5, -0.5).
std::vector<cv::Point2d> rescaled(std::vector<cv::Point2d> points, const cv::Size& from,
                                  const cv::Size& to) {
  const cv::Point2d half(0.5, 0.5);
  for (cv::Point2d& point : points) {
    point += half;
    point.x *= static_cast<double>(to.width) / from.width;
    point.y *= static_cast<double>(to.height) / from.height;
    point -= half;
  }
  return points;
}

std::vector<cv::Point2d> positionsOf(const std::vector<CarriedPoint>& points) {
  std::vector<cv::Point2d> positions;
  std::transform(points.begin(), points.end(), std::back_inserter(positions),
                 [](const CarriedPoint& point) { return point.position; });
  return positions;
}

std::string restartNote(const std::string& id, const std::string& reason) {
  return "'" + id + "' starts again: " + reason;
}

}  // namespace

std::uint64_t TargetRegistry::startAtNextFrame(const TargetRequest& request,
                                               const ChainModel& model, Answer answer) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++last_ticket_;
  if (closed_) {
    answer(kClosed);
  } else {
    waiting_.push_back({last_ticket_, request, model, std::move(answer), ""});
  }
  return last_ticket_;
}

std::optional<std::string> TargetRegistry::withdraw(std::uint64_t ticket) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = std::find_if(waiting_.begin(), waiting_.end(),
                                  [=](const Waiting& waiting) { return waiting.ticket == ticket; });
  if (found == waiting_.end()) return std::nullopt;
  std::string reason = std::move(found->reason);
  waiting_.erase(found);
  return reason;
}

TargetRegistry::Target TargetRegistry::start(const Frame& frame, const cv::Mat& image,
                                             const std::vector<cv::Point2d>& points,
                                             const ChainModel& model) {
  return {points,
          model,
          image.size(),
          image.size(),
          ChainTracker(model, image, points),
          frame.number,
          frame.image->header.stamp};
}

void TargetRegistry::startAgain(const Frame& frame, const cv::Mat& image,
                                const std::vector<cv::Point2d>& points, const ChainModel& model,
                                Target* target) {
  Target again = start(frame, image, points, model);
  again.given_points = rescaled(target->given_points, target->image_size, image.size());
  again.given_model = target->given_model;
  again.given_size = target->given_size;
  *target = std::move(again);
}

void TargetRegistry::startAt(const Frame& frame, const TargetRequest& request,
                             const ChainModel& model, const ImageHistory& history) {
  std::uint64_t last_frame = 0;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    last_frame = last_frame_;
  }
  // Most frames are caught up with while the worker goes on; the lock is held for the few that it
  // has processed meanwhile.
  Target target = start(frame, toBgr8(frame.image)->image, request.points, model);
  catchUp(history, last_frame, &target);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (closed_) throw std::invalid_argument(kClosed);
  catchUp(history, last_frame_, &target);
  targets_.insert_or_assign(request.id, std::move(target));
  refuseWaiting(request.id, kReplaced, &waiting_);
}

void TargetRegistry::catchUp(const ImageHistory& history, std::uint64_t up_to, Target* target) {
  for (const Frame& frame : history.between(target->frame_number, up_to)) {
    cv_bridge::CvImageConstPtr image;
    try {
      image = toBgr8(frame.image);
    } catch (const std::invalid_argument&) {
      continue;  // the worker has skipped and reported it, too
    }
    target->tracker.update(image->image);
    target->frame_number = frame.number;
    target->stamp = frame.image->header.stamp;
  }
}

bool TargetRegistry::remove(const std::string& id) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool was_tracked = targets_.erase(id) > 0;
  const bool has_waited = refuseWaiting(id, kRemoved, &waiting_);
  return was_tracked || has_waited;
}

bool TargetRegistry::refuseWaiting(const std::string& id, const std::string& reason,
                                   std::vector<Waiting>* waiting) {
  const auto others = std::stable_partition(
      waiting->begin(), waiting->end(), [&](const Waiting& one) { return one.request.id != id; });
  const bool any = others != waiting->end();
  std::for_each(others, waiting->end(), [&](Waiting& one) { one.answer(reason); });
  waiting->erase(others, waiting->end());
  return any;
}

std::size_t TargetRegistry::restartAll() {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (auto& [id, target] : targets_) target.restart = true;
  return targets_.size();
}

void TargetRegistry::close() {
  const std::lock_guard<std::mutex> lock(mutex_);
  closed_ = true;
  for (Waiting& waiting : waiting_) waiting.answer(kClosed);
  waiting_.clear();
}

FrameResult TargetRegistry::process(const Frame& frame, const cv::Mat& image) {
  const std::lock_guard<std::mutex> lock(mutex_);
  FrameResult result;
  advanceAll(frame, image, &result);
  startWaiting(frame, image, &result);
  last_frame_ = frame.number;
  for (const auto& [id, target] : targets_) {
    // A target started on a frame that has yet to be processed is not told of before.
    if (target.frame_number > frame.number) continue;
    // A target that has failed on this frame is not known to be anywhere in it.
    ChainState state = target.tracker.state();
    if (target.frame_number < frame.number) {
      state.status = TrackingStatus::kLost;
      state.confidence = 0.0;
    }
    result.objects.push_back(toMsg(state, id, target.tracker.model().name, image.size()));
  }
  return result;
}

/// They share nothing but the image: each has a thread to itself, or one all threads.
void TargetRegistry::advanceAll(const Frame& frame, const cv::Mat& image, FrameResult* result) {
  std::vector<std::pair<const std::string*, Target*>> targets;
  targets.reserve(targets_.size());
  for (auto& [id, target] : targets_) targets.emplace_back(&id, &target);
  std::vector<FrameResult> results(targets.size());
  const auto advance_some = [&](const cv::Range& range) {
    for (auto i = static_cast<std::size_t>(range.start); i < static_cast<std::size_t>(range.end);
         ++i) {
      targets[i].second->tracker.useThreads(targets.size() == 1 ? threads_ : 1);
      advanceAndTell(frame, image, *targets[i].first, targets[i].second, &results[i]);
    }
  };
  const cv::Range all(0, static_cast<int>(targets.size()));
  if (all.size() == 1) {
    advance_some(all);
  } else {
    cv::parallel_for_(all, advance_some, threads_);
  }
  for (FrameResult& one : results) {
    std::move(one.notes.begin(), one.notes.end(), std::back_inserter(result->notes));
    std::move(one.faults.begin(), one.faults.end(), std::back_inserter(result->faults));
  }
}

void TargetRegistry::advanceAndTell(const Frame& frame, const cv::Mat& image, const std::string& id,
                                    Target* target, FrameResult* result) {
  const std::string break_in_stream = breakInStream(frame, image, *target);
  try {
    if (target->frame_number < frame.number) advance(frame, image, target);
    if (!break_in_stream.empty()) result->notes.push_back(restartNote(id, break_in_stream));
  } catch (const std::exception& error) {
    const std::string cannot_start =
        break_in_stream.empty() ? "" : break_in_stream + ", it cannot start again: ";
    result->faults.push_back({id, cannot_start + error.what()});
  }
}

std::string TargetRegistry::breakInStream(const Frame& frame, const cv::Mat& image,
                                          const Target& target) {
  const ros::Time& stamp = frame.image->header.stamp;
  std::ostringstream text;
  if (target.frame_number >= frame.number) return "";
  if (target.restart) {
    text << "as it was asked to";
  } else if (wentBack(target.stamp, stamp)) {
    text << "time went back from " << target.stamp << " to " << stamp << " [s]";
  } else if (image.size() != target.image_size) {
    text << "the image's size changed from " << target.image_size << " to " << image.size()
         << " px";
  }
  return text.str();
}

void TargetRegistry::advance(const Frame& frame, const cv::Mat& image, Target* target) {
  const cv::Size old_size = target->image_size;
  const ChainState& state = target->tracker.state();
  const ChainModel& model = target->given_model;
  if (target->restart || wentBack(target->stamp, frame.image->header.stamp)) {
    const auto points = rescaled(target->given_points, old_size, image.size());
    const bool suits = image.size() == target->given_size;
    startAgain(frame, image, points, suits ? model : withRoomForParts(model, points), target);
  } else if (image.size() != old_size) {
    if (state.status == TrackingStatus::kLost) {
      throw std::runtime_error("it is lost, and found again in images of the old size only");
    }
    const auto points = rescaled(positionsOf(state.points), old_size, image.size());
    startAgain(frame, image, points, withRoomForParts(model, points), target);
  } else {
    target->tracker.update(image);
    target->frame_number = frame.number;
    target->stamp = frame.image->header.stamp;
  }
}

bool TargetRegistry::tryToStart(const Frame& frame, const cv::Mat& image, Waiting& waiting,
                                std::vector<Waiting>* earlier) {
  std::string refusal;
  try {
    targets_.insert_or_assign(waiting.request.id,
                              start(frame, image, waiting.request.points, waiting.model));
    refuseWaiting(waiting.request.id, kReplaced, earlier);
  } catch (const NothingToSee& error) {
    waiting.reason = error.what();
    return false;
  } catch (const std::exception& error) {
    refusal = error.what();
  }
  waiting.answer(refusal);
  return true;
}

void TargetRegistry::startWaiting(const Frame& frame, const cv::Mat& image, FrameResult* result) {
  std::vector<Waiting> still_waiting;
  for (Waiting& waiting : waiting_) {
    if (!tryToStart(frame, image, waiting, &still_waiting)) {
      still_waiting.push_back(std::move(waiting));
    }
  }
  waiting_ = std::move(still_waiting);
  for (const Waiting& waiting : waiting_) {
    result->faults.push_back({waiting.request.id, "waits to start: " + waiting.reason});
  }
}

}  // namespace chain_tracker
