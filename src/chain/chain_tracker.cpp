// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/chain_tracker.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "chain_tracker/chain/carried_shape.h"
#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/object_appearance.h"
#include "chain_tracker/chain/part_costs.h"
#include "chain_tracker/chain/pose_search.h"
#include "chain_tracker/chain/similarity_fit.h"
#include "chain_tracker/chain/target_checks.h"

namespace chain_tracker {
namespace {

/// Cells of the coarse lattice along a part's window.
constexpr double kCellsPerWindow = 8.0;
/// Steps of the refined lattice in one of the coarse lattice, at most.
constexpr int kRefinedSteps = 4;
/// Cells left along a window when a wide search makes the lattice coarser.
constexpr double kFewestCells = 3.0;
/// Candidates along a side of the search window up to which the lattice stays fine.
constexpr double kMostCandidates = 64.0;
/// Reach of the widest search, fraction of the image diagonal.
constexpr double kWidestSearch = 0.5;
/// Of the refinement around the coarse match [px]: the windows of the coarse lattice are rounded to
/// whole cells, which moves their optimum however fine the lattice is.
constexpr int kLeastReach = 4;
/// Keeps the fit defined when no part is seen.
constexpr double kSmallestWeight = 1e-3;

class Stopwatch {
 public:
  /// Time since the last lap or construction [ms].
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double, std::milli> elapsed = now - start_;
    start_ = now;
    return elapsed.count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

SegmentPose poseOf(const SegmentState& segment) {
  return {segment.image_from_segment.angle, segment.image_from_segment.scale};
}

/// The match at full resolution; no parts if the springs allow no chain.
struct Refinement {
  SegmentPose pose;
  double energy = 0.0;
  std::vector<RefinedPart> parts;
};

double clampedTurn(double from, double to, double limit) {
  return wrapAngle(from + std::clamp(wrapAngle(to - from), -limit, limit));
}

double clampedScale(double from, double to, double limit) {
  return from * std::exp(std::clamp(std::log(to / from), -limit, limit));
}

}  // namespace

class ChainTracker::Implementation {
 public:
  Implementation(const ChainModel& model, const cv::Mat& image,
                 const std::vector<cv::Point2d>& points)
      : model_(checked(model, image)),
        layout_(checked(layOut(model, points), image.size())),
        shape_(segment()),
        appearance_(learnAppearance(image, layout_, model.appearance)),
        image_size_(image.size()),
        image_type_(image.type()),
        state_(initialState()) {}

  const ChainState& update(const cv::Mat& image) {
    requireSameKind(image, image_size_, image_type_);
    Stopwatch watch;
    StepTimes times;
    const CandidateGrid grid = coarseGrid();
    computeCosts(image, grid);
    times.part_costs = watch.lap();
    const SegmentPose previous = poseOf(state_.segments.front());
    const PoseMatch match = searchPose(segment(), segmentModel(), previous, coarsePoses(previous),
                                       grid, costs_, solver_workspace_);
    times.matching = watch.lap();
    const Refinement refinement = refine(image, grid, previous, match);
    times.refinement = watch.lap();
    accept(refinement);
    times.pose = watch.lap();
    state_.times = times;
    return state_;
  }

  const ChainState& state() const { return state_; }
  const ChainModel& model() const { return model_; }

 private:
  static const ChainModel& checked(const ChainModel& model, const cv::Mat& image) {
    requireModel(model);
    requireImage(image);
    return model;
  }

  static ChainLayout checked(ChainLayout layout, const cv::Size& image_size) {
    requirePartsFit(layout, image_size);
    requireInside(layout.silhouette, image_size);
    return layout;
  }

  const SegmentLayout& segment() const { return layout_.segments.front(); }
  const SegmentModel& segmentModel() const { return model_.segments.front(); }

  ChainState initialState() const {
    ChainState state;
    for (const PartLayout& part : segment().parts) {
      PartState part_state;
      part_state.position = segment().image_from_segment.apply(part.position);
      part_state.side = part.side;
      part_state.confidence = 1.0;
      part_state.visible = true;
      part_state.covariance = cv::Matx22d::zeros();
      state.parts.push_back(part_state);
    }
    state.segments = {{segment().name, segment().image_from_segment, 1.0, 0,
                       static_cast<int>(state.parts.size())}};
    state.confidence = 1.0;
    carryShape(state);
    return state;
  }

  /// Twice as far with every frame in which the object was not found.
  double searchRadius() const {
    const double diagonal = std::hypot(image_size_.width, image_size_.height);
    const double reach = std::ldexp(model_.search.radius, std::min(frames_lost_, 16));
    return diagonal * std::min(reach, std::max(model_.search.radius, kWidestSearch));
  }

  /// An eighth of a window, or coarser where a wide search would have too many candidates.
  int coarseStep(double side, double radius) const {
    const double fine = side / kCellsPerWindow;
    const double affordable = std::min(2.0 * radius / kMostCandidates, side / kFewestCells);
    return std::max(1, static_cast<int>(std::lround(std::max(fine, affordable))));
  }

  CandidateGrid coarseGrid() const {
    std::vector<cv::Point2d> centers;
    for (const PartState& part : state_.parts) centers.push_back(part.position);
    const double side = state_.parts.front().side;
    const double radius = searchRadius();
    return makeCandidateGrid(centers, side, coarseStep(side, radius), radius);
  }

  void computeCosts(const cv::Mat& image, const CandidateGrid& grid) {
    computePartCosts(image, appearance_.palette, appearance_.parts, grid, model_.appearance.weight,
                     costs_, cost_workspace_);
  }

  PoseGrid coarsePoses(const SegmentPose& previous) const {
    const SegmentModel& model = segmentModel();
    return {previous, model.orientation_hypotheses, model.orientation_step, model.scale_hypotheses,
            model.scale_step};
  }

  /// Half the coarse steps around the best coarse pose. Where the coarse search has a single
  /// hypothesis, the fit alone turns or rescales the segment, by up to the coarse step.
  PoseGrid finePoses(const SegmentPose& coarse) const {
    const SegmentModel& model = segmentModel();
    const auto fineStep = [](int hypotheses, double step) {
      return hypotheses > 1 ? 0.5 * step : 2.0 * step;
    };
    return {coarse, std::min(3, model.orientation_hypotheses),
            fineStep(model.orientation_hypotheses, model.orientation_step),
            std::min(3, model.scale_hypotheses),
            fineStep(model.scale_hypotheses, model.scale_step)};
  }

  /// Candidates up to a coarse step around the coarse match.
  CandidateGrid fineGrid(const CandidateGrid& coarse, const PoseMatch& match,
                         const SegmentPose& pose) const {
    std::vector<cv::Point2d> centers;
    for (size_t k = 0; k < match.states.size(); ++k) {
      centers.push_back(coarse.positionOf(k, match.states[k]));
    }
    const int step = (coarse.lattice.step + kRefinedSteps - 1) / kRefinedSteps;
    const double side = segment().parts.front().side * pose.scale;
    const double reach = std::max(kLeastReach, coarse.lattice.step + step);
    return makeCandidateGrid(centers, side, step, reach);
  }

  Refinement refine(const cv::Mat& image, const CandidateGrid& coarse, const SegmentPose& previous,
                    const PoseMatch& match) {
    if (!match.found()) return {};
    const SegmentPose coarse_pose = interpolatePose(coarsePoses(previous), match);
    const CandidateGrid fine = fineGrid(coarse, match, coarse_pose);
    computeCosts(image, fine);
    const PoseGrid poses = finePoses(coarse_pose);
    const PoseMatch refined =
        searchPose(segment(), segmentModel(), previous, poses, fine, costs_, solver_workspace_);
    if (!refined.found()) return {};
    const SegmentPose pose = interpolatePose(poses, refined);
    return {pose, refined.energy(), refineChain(segment(), pose, fine, costs_, solver_workspace_)};
  }

  /// The refined match becomes the state if it is good enough; otherwise the object is LOST and
  /// stays where it was last believed to be.
  void accept(const Refinement& refinement) {
    ChainState found = state_;
    found.confidence = 0.0;
    bool all_visible = true;
    for (size_t k = 0; k < refinement.parts.size(); ++k) {
      found.parts[k] = partState(refinement.parts[k]);
      found.confidence += found.parts[k].confidence / static_cast<double>(found.parts.size());
      all_visible = all_visible && found.parts[k].visible;
    }
    found.status = nextStatus(state_.status, found.confidence, all_visible, model_.search);
    if (found.status == TrackingStatus::kLost) {
      ++frames_lost_;
      state_.status = found.status;
      state_.confidence = found.confidence;
      return;
    }
    frames_lost_ = 0;
    found.energy = refinement.energy;
    found.segments.front().confidence = found.confidence;
    found.segments.front().image_from_segment = fitPose(refinement.pose, found.parts);
    carryShape(found);
    state_ = std::move(found);
  }

  PartState partState(const RefinedPart& refined) const {
    PartState part;
    part.position = refined.position;
    part.covariance = refined.covariance;
    part.confidence = std::clamp(1.0 - refined.appearance / model_.appearance.weight, 0.0, 1.0);
    part.visible = part.confidence >= model_.search.occluded_below;
    return part;
  }

  /// Least squares over the parts, within the resolution of the poses searched: beyond it, the
  /// energy knows better than the parts, which lean inwards wherever the object is uniform.
  Similarity fitPose(const SegmentPose& searched, const std::vector<PartState>& parts) const {
    std::vector<cv::Point2d> reference;
    std::vector<cv::Point2d> found;
    std::vector<double> weights;
    for (size_t k = 0; k < parts.size(); ++k) {
      reference.push_back(segment().parts[k].position);
      found.push_back(parts[k].position);
      weights.push_back(parts[k].confidence + kSmallestWeight);
    }
    const Similarity fit = fitSimilarity(reference, found, weights);
    const PoseGrid poses = finePoses(searched);
    const double angle = clampedTurn(searched.orientation, fit.angle, 0.5 * poses.orientation_step);
    const double scale = clampedScale(searched.scale, fit.scale, 0.5 * poses.scale_step);
    return {angle, scale, fitTranslation(reference, found, weights, angle, scale)};
  }

  /// All that follows from the parts' positions and the segment's pose.
  void carryShape(ChainState& state) const {
    const SegmentState& segment_state = state.segments.front();
    const std::vector<double> orientations =
        partOrientations(segment(), segment_state, state.parts);
    for (size_t k = 0; k < state.parts.size(); ++k) {
      state.parts[k].orientation = orientations[k];
      state.parts[k].side = segment().parts[k].side * segment_state.image_from_segment.scale;
    }
    state.points = shape_.points(segment_state, state.parts);
    state.outline = shape_.outline(segment_state);
    state.box = shape_.box(segment_state);
  }

  ChainModel model_;
  ChainLayout layout_;
  CarriedShape shape_;
  ObjectAppearance appearance_;
  cv::Size image_size_;
  int image_type_;
  ChainState state_;
  int frames_lost_ = 0;
  std::vector<cv::Mat1f> costs_;
  PartCostsWorkspace cost_workspace_;
  ChainSolverWorkspace solver_workspace_;
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
