// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/chain_tracker.h"

#include <algorithm>
#include <utility>

#include "chain_search.h"
#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/link_width.h"
#include "chain_tracker/chain/object_shape.h"
#include "chain_tracker/chain/target_checks.h"
#include "line_width.h"
#include "second_look.h"

namespace chain_tracker {
namespace {

/// Of what the parts can tell: more than that is hidden of an object that counts as occluded. The
/// corner windows of a box show mostly background, which changes.
constexpr double kMostHidden = 0.1;

}  // namespace

class ChainTracker::Implementation {
 public:
  Implementation(const ChainModel& model, const cv::Mat& image,
                 const std::vector<cv::Point2d>& points)
      : model_(checked(model, image, points)),
        layout_(checked(layOut(model_, points), image.size())),
        shape_(layout_.segments),
        image_size_(image.size()),
        image_type_(image.type()),
        state_(initialState()),
        search_(model_, image, layout_, state_),
        second_look_(model_, layout_, image_size_, state_, search_, shape_) {}

  const ChainState& update(const cv::Mat& image) {
    requireSameKind(image, image_size_, image_type_);
    search_.show(image, searchLight());
    second_look_.show(image);
    if (state_.status == TrackingStatus::kLost) {
      found_ = second_look_.findLost(1 + frames_lost_);
    } else {
      follow();
    }
    accept();
    return state_;
  }

  void useThreads(int threads) {
    requireThreads(threads);
    search_.useThreads(threads);
  }

  const ChainState& state() const { return state_; }
  const ChainModel& model() const { return model_; }

 private:
  static ChainModel checked(const ChainModel& model, const cv::Mat& image,
                            const std::vector<cv::Point2d>& points) {
    requireModel(model);
    requireImage(image);
    const ChainModel expanded = forPolyline(model, points.size());
    requireModel(expanded);
    const ChainLayout layout = checked(layOut(expanded, points), image.size());
    requireContrast(image, layout.silhouette);
    const ChainModel with_links = withMeasuredAspects(expanded, image, points);
    const ChainModel measured = withMeasuredWindows(with_links, image, points);
    return havePartsRoom(layOut(measured, points), image.size()) ? measured : expanded;
  }

  static ChainLayout checked(ChainLayout layout, const cv::Size& image_size) {
    requirePartsFit(layout, image_size);
    requireInside(layout.silhouette, image_size);
    return layout;
  }

  ChainState initialState() {
    ChainState state;
    for (const SegmentLayout& segment : layout_.segments) {
      state.segments.push_back({segment.name, segment.image_from_segment, 1.0,
                                static_cast<int>(state.parts.size()),
                                static_cast<int>(segment.parts.size())});
      for (const PartLayout& part : segment.parts) {
        PartState part_state;
        part_state.position = segment.image_from_segment.apply(part.position);
        part_state.confidence = 1.0;
        part_state.visible = true;
        part_state.covariance = cv::Matx22d::zeros();
        state.parts.push_back(part_state);
      }
    }
    state.confidence = 1.0;
    shape_.carry(state);
    return state;
  }

  /// Nothing tells how the light changes on what is not seen. Two frames each, so that both kinds
  /// of SecondLook see it in either.
  SearchLight searchLight() const {
    return frames_lost_ / 2 % 2 == 1 ? SearchLight::kFirst : SearchLight::kLatest;
  }

  /// Where the object is if it has moved on as usual; elsewhere if there is reason to doubt that.
  void follow() {
    const double radius = second_look_.searchRadius();
    search_.find(state_, {radius, model_.search.travel_weight / radius}, found_);
    second_look_.reconsider(state_, found_);
  }

  /// What was found becomes the state if it is good enough; otherwise the object is LOST and stays
  /// where it was last believed to be.
  void accept() {
    ChainState& found = found_.state;
    const double hidden = search_.expectations().hiddenShare(found.parts);
    const bool is_seen = hidden <= kMostHidden;
    const double usual = search_.expectations().usualConfidence();
    found.status = nextStatus(state_.status, found.confidence, usual, is_seen, model_.search);
    if (found.status == TrackingStatus::kLost) {
      ++frames_lost_;
      giveUp(found);
      return;
    }
    frames_lost_ = 0;
    shape_.carry(found);
    search_.observe(found_);
    second_look_.observe(found_);
    std::swap(state_, found);
  }

  /// Positions stay the last believed ones; nothing else is told of them any more.
  void giveUp(const ChainState& found) {
    state_.status = found.status;
    state_.confidence = found.confidence;
    for (SegmentState& segment : state_.segments) segment.confidence = 0.0;
    for (PartState& part : state_.parts) {
      part.confidence = 0.0;
      part.visible = false;
    }
    for (CarriedPoint& point : state_.points) {
      point.confidence = 0.0;
      point.visible = false;
    }
  }

  ChainModel model_;
  ChainLayout layout_;
  ObjectShape shape_;
  cv::Size image_size_;
  int image_type_;
  ChainState state_;
  FoundChain found_;  // in this frame
  ChainSearch search_;
  SecondLook second_look_;
  int frames_lost_ = 0;
};

ChainTracker::ChainTracker(const ChainModel& model, const cv::Mat& image,
                           const std::vector<cv::Point2d>& points)
    : implementation_(std::make_unique<Implementation>(model, image, points)) {}
ChainTracker::~ChainTracker() = default;
ChainTracker::ChainTracker(ChainTracker&&) noexcept = default;
ChainTracker& ChainTracker::operator=(ChainTracker&&) noexcept = default;

const ChainState& ChainTracker::update(const cv::Mat& image) {
  return implementation_->update(image);
}
void ChainTracker::useThreads(int threads) { implementation_->useThreads(threads); }
const ChainState& ChainTracker::state() const { return implementation_->state(); }
const ChainModel& ChainTracker::model() const { return implementation_->model(); }

}  // namespace chain_tracker
