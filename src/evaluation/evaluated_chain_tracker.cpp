// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "chain_tracker/chain/chain_tracker.h"
#include "chain_tracker/evaluation/evaluated_tracker.h"

namespace chain_tracker {
namespace {

class EvaluatedChainTracker : public EvaluatedTracker {
 public:
  EvaluatedChainTracker(ChainModel model, std::vector<cv::Point2d> points, int threads)
      : model_(std::move(model)), points_(std::move(points)), threads_(threads) {}

  std::string name() const override { return "chain_tracker"; }

  TrackedFrame start(const cv::Mat& image) override {
    tracker_ = std::make_unique<ChainTracker>(model_, image, points_);
    tracker_->useThreads(threads_);
    return report(tracker_->state());
  }

  TrackedFrame update(const cv::Mat& image) override { return report(tracker_->update(image)); }

 private:
  static TrackedFrame report(const ChainState& state) {
    const Similarity pose = meanPose(state);
    return {toString(state.status),
            state.confidence,
            state.status == TrackingStatus::kLost,
            state.box,
            state.outline,
            pose.angle,
            pose.scale,
            state.parts,
            state.points};
  }

  ChainModel model_;
  std::vector<cv::Point2d> points_;
  int threads_;
  std::unique_ptr<ChainTracker> tracker_;
};

}  // namespace

std::unique_ptr<EvaluatedTracker> makeChainTracker(const ChainModel& model,
                                                   const std::vector<cv::Point2d>& points,
                                                   int threads) {
  return std::make_unique<EvaluatedChainTracker>(model, points, threads);
}

}  // namespace chain_tracker
