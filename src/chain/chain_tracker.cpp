// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/chain_tracker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "chain_search.h"
#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/link_width.h"
#include "chain_tracker/chain/object_shape.h"
#include "chain_tracker/chain/target_checks.h"
#include "state_motion.h"
#include "stopwatch.h"

namespace chain_tracker {
namespace {

/// Reach of the widest search, fraction of the image diagonal: for an object in doubt, and for one
/// that is lost and may come back anywhere.
constexpr double kWidestInDoubt = 0.5;
constexpr double kWidestWhenLost = 1.0;
/// A doubtful object is looked for elsewhere in every so many frames.
constexpr int kFramesPerLook = 2;
/// How much more likeness it takes to believe that it is there, or that a line is.
constexpr double kClearlyBetter = 0.1;
constexpr double kBetterLine = 0.05;
/// Of an object in doubt, to each side, at least [rad].
constexpr double kLeastTurn = 0.4;
/// Of what the parts can tell: more than that is hidden of an object that counts as occluded. The
/// corner windows of a box show mostly background, which changes.
constexpr double kMostHidden = 0.1;
/// Of the usual likeness: a state that is trusted to be right, by which it is looked for later.
constexpr double kTrusted = 0.8;
/// The same of a line, which is in doubt until then: found again shifted along itself it looks much
/// like the object, but does not slide back by itself.
constexpr double kTrustedLine = 0.95;
/// A line that is found again may have bent by so much more than between two frames, and that in up
/// to so many steps, as long as each makes it look more as learned by kLeastGain.
constexpr double kLoose = 3.0;
constexpr int kRefits = 4;
constexpr double kLeastGain = 0.01;

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
        trusted_(state_),
        search_(model_, image, layout_, state_) {}

  const ChainState& update(const cv::Mat& image) {
    requireSameKind(image, image_size_, image_type_);
    search_.show(image, searchLight());
    times_ = StepTimes();
    if (state_.status == TrackingStatus::kLost) {
      found_ = look(1 + frames_lost_);
    } else {
      follow();
    }
    Stopwatch watch;
    accept();
    times_.pose += watch.lap();
    state_.times = times_;
    return state_;
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
    ChainModel measured = withMeasuredAspects(expanded, image, points);
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
  /// of look() see it in either.
  SearchLight searchLight() const {
    return frames_lost_ / 2 % 2 == 1 ? SearchLight::kFirst : SearchLight::kLatest;
  }

  /// Of a search that has failed so often: twice as far every time.
  double searchRadius(int failures) const {
    const double diagonal = std::hypot(image_size_.width, image_size_.height);
    const double reach = std::ldexp(model_.search.radius, std::min(failures, 16));
    const bool is_lost = state_.status == TrackingStatus::kLost;
    const double widest = is_lost ? kWidestWhenLost : kWidestInDoubt;
    return diagonal * std::min(reach, std::max(model_.search.radius, widest));
  }

  FoundChain find(const ChainState& sought, const SearchRange& range) {
    FoundChain found;
    search_.find(sought, range, found);
    times_ += found.state.times;
    return found;
  }

  FoundChain findAnywhere(const ChainState& sought, double reach, const SearchRange& range) {
    FoundChain found;
    search_.findAnywhere(sought, reach, range, found);
    times_ += found.state.times;
    return found;
  }

  /// Where the object is if it has moved on as usual; elsewhere if there is reason to doubt that.
  void follow() {
    const double radius = searchRadius(0);
    search_.find(state_, {radius, model_.search.travel_weight / radius}, found_);
    times_ += found_.state.times;
    if (!isDoubtful(found_)) {
      frames_doubted_ = 0;
      return;
    }
    ++frames_doubted_;
    if (frames_doubted_ == 1) {
      for (const int side : {-1, 1}) preferBetter(turned(side), found_);
    } else if (frames_doubted_ % kFramesPerLook == 0) {
      preferBetter(look(frames_doubted_ / kFramesPerLook), found_);
    }
    if (!isDoubtful(found_)) frames_doubted_ = 0;
  }

  bool isDoubtful(const FoundChain& found) const {
    const double doubt_below = model_.search.doubt_below;
    const bool must_reassure = isLine() && frames_doubted_ > 0;
    const double least = must_reassure ? std::max(doubt_below, kTrustedLine) : doubt_below;
    return found.likeness < least * search_.expectations().usualLikeness();
  }

  /// It bends anywhere, and often looks the same all along.
  bool isLine() const {
    return layout_.segments.size() == 1 && layout_.segments.front().layout == Layout::kDeformable;
  }

  /// A chain elsewhere is believed in if it is clearly better and would do to end a loss.
  void preferBetter(FoundChain other, FoundChain& found) const {
    const bool is_sure = other.state.confidence >= model_.search.found_above;
    const double gain = isLine() ? kBetterLine : kClearlyBetter;
    if (is_sure && other.likeness > found.likeness + gain) found = std::move(other);
  }

  /// Just beyond what the hypotheses cover, to one side.
  FoundChain turned(int side) {
    const SegmentModel& model = model_.segments.front();
    const double covered = model.orientation_hypotheses * model.orientation_step;
    ChainState sought = state_;
    turnWhole(side * std::clamp(covered, kLeastTurn, CV_PI), sought);
    return find(sought, {searchRadius(1), 0.0});
  }

  /// Around where the object was last seen for sure: a chain as it was then or, every other time,
  /// one around wherever its segments fit best.
  FoundChain look(int failures) {
    const double reach = searchRadius(failures);
    const SearchRange nearby{searchRadius(0), 0.0};
    const bool is_placed = failures % 2 == 0;
    FoundChain found =
        is_placed ? findAnywhere(trusted_, reach, nearby) : find(trusted_, {reach, 0.0});
    if (isLine()) found = refitted(std::move(found));
    if (found.state.confidence >= model_.search.found_above) preferBetter(reversed(found), found);
    return found;
  }

  /// A line bent along what it was found on, then as stiff as ever: one that may bend at will fits
  /// anything. Springs that remember where each edge pointed keep it from sliding along itself.
  FoundChain refitted(FoundChain found) {
    const double radius = searchRadius(0);
    for (int i = 0; i < kRefits; ++i) {
      shape_.carry(found.state);
      FoundChain bent = find(found.state, {radius, 0.0, kLoose});
      if (bent.likeness < found.likeness + kLeastGain) break;
      found = std::move(bent);
    }
    shape_.carry(found.state);
    return find(found.state, {radius, 0.0});
  }

  /// What is found of an object whose two ends look alike may be the wrong way round.
  FoundChain reversed(const FoundChain& found) {
    ChainState sought = found.state;
    turnWhole(CV_PI, sought);
    return find(sought, {searchRadius(0), 0.0});
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
    const double least = isLine() ? kTrustedLine : kTrusted;
    if (found_.likeness >= least * search_.expectations().usualLikeness()) trusted_ = found;
    std::swap(state_, found);
  }

  /// Positions stay the last believed ones; nothing else is told of them any more.
  void giveUp(const ChainState& found) {
    state_.status = found.status;
    state_.confidence = found.confidence;
    state_.energy = found.energy;
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
  ChainState trusted_;  // when the object was last seen for sure
  FoundChain found_;    // in this frame
  ChainSearch search_;
  StepTimes times_;
  int frames_lost_ = 0;
  int frames_doubted_ = 0;
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
const ChainState& ChainTracker::state() const { return implementation_->state(); }
const ChainModel& ChainTracker::model() const { return implementation_->model(); }

}  // namespace chain_tracker
