// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/chain_tracker.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/chain_matcher.h"
#include "chain_tracker/chain/chain_refinement.h"
#include "chain_tracker/chain/object_appearance.h"
#include "chain_tracker/chain/object_shape.h"
#include "chain_tracker/chain/part_costs.h"
#include "chain_tracker/chain/pose_grid.h"
#include "chain_tracker/chain/similarity_fit.h"
#include "chain_tracker/chain/target_checks.h"
#include "chain_tracker/chain/texture_costs.h"
#include "lost_search.h"

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
/// Of a part whose window shows nothing of the object, of the largest cost.
constexpr double kLeastEvidence = 0.1;
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

std::vector<SegmentPose> posesOf(const ChainState& state) {
  std::vector<SegmentPose> poses;
  for (const SegmentState& segment : state.segments) {
    poses.push_back({segment.image_from_segment.angle, segment.image_from_segment.scale});
  }
  return poses;
}

/// The match at full resolution; no parts if the springs allow no chain.
struct Refinement {
  std::vector<SegmentPose> poses;
  double energy = 0.0;
  std::vector<RefinedPart> parts;
};

/// What is looked at in a frame: one entry a segment.
struct Search {
  std::vector<CandidateGrid> grids;
  std::vector<SegmentCandidates> candidates;
  std::vector<PoseGrid> poses;
};

/// Length of the chain found over that of the reference. What coils up comes nearer to its middle
/// without becoming shorter: a similarity would take that for a smaller scale.
double lengthRatio(const std::vector<cv::Point2d>& reference, const std::vector<cv::Point2d>& found,
                   const std::vector<double>& weights) {
  double reference_length = 0.0;
  double found_length = 0.0;
  for (size_t k = 1; k < found.size(); ++k) {
    const double weight = std::min(weights[k - 1], weights[k]);
    reference_length += weight * cv::norm(reference[k] - reference[k - 1]);
    found_length += weight * cv::norm(found[k] - found[k - 1]);
  }
  return found_length / reference_length;
}

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
      : model_(checked(model, image, points.size())),
        layout_(checked(layOut(model_, points), image.size())),
        shape_(layout_.segments),
        appearance_(image, layout_, model_.appearance),
        image_size_(image.size()),
        image_type_(image.type()),
        state_(initialState()) {
    for (const PartState& part : state_.parts) initial_orientations_.push_back(part.orientation);
    for (size_t k = 0; k < state_.parts.size(); ++k) evidence_.push_back(evidenceOf(k));
  }

  const ChainState& update(const cv::Mat& image) {
    requireSameKind(image, image_size_, image_type_);
    Stopwatch watch;
    StepTimes times;
    sought_ = state_;
    turnAboutMiddle(soughtTurn(model_.segments.front(), frames_lost_), sought_);
    const std::vector<SegmentPose> previous = posesOf(sought_);
    const Search coarse = coarseSearch(image, previous);
    times.part_costs = watch.lap();
    const ChainMatch match = matched(coarse, previous);
    times.matching = watch.lap();
    const Refinement refinement = refine(image, coarse, previous, match);
    times.refinement = watch.lap();
    accept(refinement);
    times.pose = watch.lap();
    state_.times = times;
    return state_;
  }

  const ChainState& state() const { return state_; }
  const ChainModel& model() const { return model_; }

 private:
  static ChainModel checked(const ChainModel& model, const cv::Mat& image, size_t points) {
    requireModel(model);
    requireImage(image);
    ChainModel expanded = forPolyline(model, points);
    requireModel(expanded);
    return expanded;
  }

  static ChainLayout checked(ChainLayout layout, const cv::Size& image_size) {
    requirePartsFit(layout, image_size);
    requireInside(layout.silhouette, image_size);
    return layout;
  }

  size_t segments() const { return layout_.segments.size(); }

  ChainState initialState() const {
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

  /// Twice as far with every frame in which the object was not found.
  double searchRadius() const {
    const double diagonal = std::hypot(image_size_.width, image_size_.height);
    const double reach = std::ldexp(model_.search.radius, std::min(frames_lost_, 16));
    return diagonal * std::min(reach, std::max(model_.search.radius, kWidestSearch));
  }

  double sideOf(size_t m, double scale) const {
    return layout_.segments[m].parts.front().side * scale;
  }

  double smallestSide(const std::vector<SegmentPose>& poses) const {
    double smallest = sideOf(0, poses[0].scale);
    for (size_t m = 1; m < segments(); ++m) {
      smallest = std::min(smallest, sideOf(m, poses[m].scale));
    }
    return smallest;
  }

  /// An eighth of a window, or coarser where a wide search would have too many candidates.
  int coarseStep(double side, double radius) const {
    const double fine = side / kCellsPerWindow;
    const double affordable = std::min(2.0 * radius / kMostCandidates, side / kFewestCells);
    return std::max(1, static_cast<int>(std::lround(std::max(fine, affordable))));
  }

  /// Around where the nodes were last believed to be.
  Search coarseSearch(const cv::Mat& image, const std::vector<SegmentPose>& previous) {
    std::vector<std::vector<cv::Point2d>> centers;
    for (size_t m = 0; m < segments(); ++m) centers.push_back(nodePositions(sought_, m));
    const double radius = searchRadius();
    const int step = coarseStep(smallestSide(previous), radius);
    Search search = candidatesAround(image, centers, previous, step, radius);
    for (size_t m = 0; m < segments(); ++m) {
      const SegmentModel& model = model_.segments[m];
      search.poses.push_back({previous[m], model.orientation_hypotheses, model.orientation_step,
                              model.scale_hypotheses, model.scale_step});
    }
    return search;
  }

  /// Of the segment's joints and parts. Both segments at a joint say the same.
  std::vector<cv::Point2d> nodePositions(const ChainState& state, size_t m) const {
    const SegmentLayout& segment = layout_.segments[m];
    const SegmentState& segment_state = state.segments[m];
    const auto first = state.parts.begin() + segment_state.first_part;
    std::vector<cv::Point2d> positions;
    if (segment.entry) positions.push_back(jointPosition(state, m - 1));
    for (auto part = first; part != first + segment_state.part_count; ++part) {
      positions.push_back(part->position);
    }
    if (segment.exit) positions.push_back(jointPosition(state, m));
    return positions;
  }

  cv::Point2d jointPosition(const ChainState& state, size_t m) const {
    return 0.5 * (state.segments[m].image_from_segment.apply(*layout_.segments[m].exit) +
                  state.segments[m + 1].image_from_segment.apply(*layout_.segments[m + 1].entry));
  }

  /// `centers`: of the nodes of each segment.
  Search candidatesAround(const cv::Mat& image,
                          const std::vector<std::vector<cv::Point2d>>& centers,
                          const std::vector<SegmentPose>& poses, int step, double radius) {
    Search search;
    for (size_t m = 0; m < segments(); ++m) {
      const SegmentLayout& segment = layout_.segments[m];
      const auto first = centers[m].begin() + (segment.entry ? 1 : 0);
      const std::vector<cv::Point2d> parts(first, first + static_cast<int>(segment.parts.size()));
      search.grids.push_back(makeCandidateGrid(parts, sideOf(m, poses[m].scale), step, radius));
      search.candidates.push_back(candidatesOf(segment, search.grids[m], centers[m].back()));
      if (m > 0) search.candidates[m].origins.front() = search.candidates[m - 1].origins.back();
      computeCosts(image, m, search);
    }
    return search;
  }

  /// The costs of the parts' states are still to be computed; a joint at the end lies on the
  /// lattice of its segment.
  static SegmentCandidates candidatesOf(const SegmentLayout& segment, const CandidateGrid& grid,
                                        const cv::Point2d& end) {
    SegmentCandidates candidates;
    candidates.step = grid.lattice.step;
    candidates.states = grid.states;
    if (segment.entry) candidates.origins.emplace_back();
    for (size_t k = 0; k < segment.parts.size(); ++k) {
      candidates.origins.push_back(grid.positionOf(k, {0.0, 0.0}));
    }
    if (segment.exit) candidates.origins.push_back(grid.originAround(end));
    return candidates;
  }

  void computeCosts(const cv::Mat& image, size_t m, Search& search) {
    const SegmentLayout& segment = layout_.segments[m];
    const auto first_part = static_cast<size_t>(sought_.segments[m].first_part);
    std::vector<RootHistogram> colors;
    std::vector<WindowTexture> textures;
    for (size_t k = first_part; k < first_part + segment.parts.size(); ++k) {
      const PartAppearance& part = appearance_.part(k, turnOf(k));
      colors.push_back(part.colors);
      textures.push_back(part.texture);
    }
    std::vector<cv::Mat1f>& costs = search.candidates[m].costs;
    const AppearanceModel& model = model_.appearance;
    computePartCosts(image, appearance_.palette(), colors, search.grids[m], model.weight, costs,
                     cost_workspace_);
    if (model.haar_weight > 0.0) {
      addTextureCosts(image, textures, search.grids[m], model.haar_weight, costs,
                      texture_workspace_);
    }
    const cv::Mat1f nothing(search.grids[m].states, 0.0F);
    if (segment.entry) costs.insert(costs.begin(), nothing);
    if (segment.exit) costs.push_back(nothing);
  }

  /// Of a part since the first frame, as it is sought [rad].
  double turnOf(size_t part) const {
    return wrapAngle(sought_.parts[part].orientation - initial_orientations_[part]);
  }

  ChainMatch matched(const Search& search, const std::vector<SegmentPose>& previous) {
    return matchChain({layout_.segments, model_, previous, search.poses, search.candidates},
                      solver_workspace_);
  }

  /// Half the coarse steps around the best coarse pose. Where the coarse search has a single
  /// hypothesis, the fit alone turns or rescales the segment, by up to the coarse step.
  static PoseGrid finePoses(const SegmentModel& model, const SegmentPose& coarse) {
    const auto fine_step = [](int hypotheses, double step) {
      return hypotheses > 1 ? 0.5 * step : 2.0 * step;
    };
    return {coarse, std::min(3, model.orientation_hypotheses),
            fine_step(model.orientation_hypotheses, model.orientation_step),
            std::min(3, model.scale_hypotheses),
            fine_step(model.scale_hypotheses, model.scale_step)};
  }

  static std::vector<SegmentPose> interpolatedPoses(const Search& search, const ChainMatch& match) {
    std::vector<SegmentPose> poses;
    for (size_t m = 0; m < search.poses.size(); ++m) {
      poses.push_back(interpolatePose(search.poses[m], match.segments[m].energies));
    }
    return poses;
  }

  /// Candidates up to a coarse step around the coarse match.
  Search fineSearch(const cv::Mat& image, const Search& coarse, const ChainMatch& match) {
    const std::vector<SegmentPose> poses = interpolatedPoses(coarse, match);
    std::vector<std::vector<cv::Point2d>> centers(segments());
    for (size_t m = 0; m < segments(); ++m) {
      const std::vector<cv::Point>& states = match.segments[m].states;
      for (size_t k = 0; k < states.size(); ++k) {
        centers[m].push_back(coarse.candidates[m].positionOf(k, cv::Point2d(states[k])));
      }
    }
    const int coarse_step = coarse.candidates.front().step;
    const int step = (coarse_step + kRefinedSteps - 1) / kRefinedSteps;
    Search search =
        candidatesAround(image, centers, poses, step, std::max(kLeastReach, coarse_step + step));
    for (size_t m = 0; m < segments(); ++m) {
      search.poses.push_back(finePoses(model_.segments[m], poses[m]));
    }
    return search;
  }

  Refinement refine(const cv::Mat& image, const Search& coarse,
                    const std::vector<SegmentPose>& previous, const ChainMatch& match) {
    if (!match.found()) return {};
    const Search fine = fineSearch(image, coarse, match);
    const ChainMatch refined = matched(fine, previous);
    if (!refined.found()) return {};
    const std::vector<SegmentPose> poses = interpolatedPoses(fine, refined);
    return {poses, refined.energy,
            refineChain(layout_.segments, poses, fine.candidates, solver_workspace_)};
  }

  /// The refined match becomes the state if it is good enough; otherwise the object is LOST and
  /// stays where it was last believed to be.
  void accept(const Refinement& refinement) {
    ChainState found = state_;
    found.confidence = 0.0;
    bool all_visible = true;
    for (size_t k = 0; k < refinement.parts.size(); ++k) {
      found.parts[k] = partState(refinement.parts[k], evidence_[k]);
      all_visible = all_visible && found.parts[k].visible;
    }
    if (!refinement.parts.empty())
      found.confidence = meanConfidence(found.parts, 0, found.parts.size());
    found.status = nextStatus(state_.status, found.confidence, all_visible, model_.search);
    if (found.status == TrackingStatus::kLost) {
      ++frames_lost_;
      state_.status = found.status;
      state_.confidence = found.confidence;
      return;
    }
    frames_lost_ = 0;
    found.energy = refinement.energy;
    for (size_t m = 0; m < segments(); ++m) fitSegment(m, refinement.poses[m], found);
    shape_.carry(found);
    state_ = std::move(found);
    relaxSprings();
  }

  /// What bends anywhere has no shape of its own: its springs rest where they were last found, so
  /// that it may bend as far as it likes, but not at once.
  void relaxSprings() {
    for (size_t m = 0; m < segments(); ++m) {
      if (layout_.segments[m].layout != Layout::kDeformable) continue;
      const std::vector<cv::Point2d> nodes = nodePositions(state_, m);
      const double orientation = state_.segments[m].image_from_segment.angle;
      std::vector<EdgeLayout>& edges = layout_.segments[m].edges;
      for (size_t k = 0; k < edges.size(); ++k) {
        edges[k].direction = wrapAngle(directionOf(nodes[k + 1] - nodes[k]) - orientation);
      }
    }
  }

  /// What a part would cost on a flat piece of background: little if its own window shows little
  /// else, so that it cannot tell whether the object is there.
  double evidenceOf(size_t part) {
    const AppearanceModel& model = model_.appearance;
    const PartAppearance& learned = appearance_.part(part, 0.0);
    const double other = learned.colors[ColorPalette::kOther];
    const double colors = std::sqrt(std::max(0.0, 1.0 - other));
    const double texture =
        0.5 * std::sqrt(std::inner_product(learned.texture.begin(), learned.texture.end(),
                                           learned.texture.begin(), 0.0));
    const double least = kLeastEvidence * (model.weight + model.haar_weight);
    return std::max(least, model.weight * colors + model.haar_weight * texture);
  }

  /// Of `count` parts, weighted by what they can tell.
  double meanConfidence(const std::vector<PartState>& parts, size_t first, size_t count) const {
    double sum = 0.0;
    double weights = 0.0;
    for (size_t k = first; k < first + count; ++k) {
      sum += evidence_[k] * parts[k].confidence;
      weights += evidence_[k];
    }
    return sum / weights;
  }

  PartState partState(const RefinedPart& refined, double evidence) const {
    PartState part;
    part.position = refined.position;
    part.covariance = refined.covariance;
    part.confidence = std::clamp(1.0 - refined.appearance / evidence, 0.0, 1.0);
    part.visible = part.confidence >= model_.search.occluded_below;
    return part;
  }

  /// Least squares over the parts, within the resolution of the poses searched: beyond it, the
  /// energy knows better than the parts, which lean inwards wherever the object is uniform.
  void fitSegment(size_t m, const SegmentPose& searched, ChainState& state) const {
    SegmentState& segment = state.segments[m];
    std::vector<cv::Point2d> reference;
    std::vector<cv::Point2d> found;
    std::vector<double> weights;
    for (size_t k = 0; k < layout_.segments[m].parts.size(); ++k) {
      const PartState& part = state.parts[static_cast<size_t>(segment.first_part) + k];
      reference.push_back(layout_.segments[m].parts[k].position);
      found.push_back(part.position);
      weights.push_back(part.confidence + kSmallestWeight);
    }
    Similarity fit = fitSimilarity(reference, found, weights);
    if (layout_.segments[m].layout == Layout::kDeformable) {
      fit.scale = lengthRatio(reference, found, weights);
    }
    const PoseGrid poses = finePoses(model_.segments[m], searched);
    const double angle = clampedTurn(searched.orientation, fit.angle, 0.5 * poses.orientation_step);
    const double scale = clampedScale(searched.scale, fit.scale, 0.5 * poses.scale_step);
    segment.image_from_segment = {angle, scale,
                                  fitTranslation(reference, found, weights, angle, scale)};
    const auto first_part = static_cast<size_t>(segment.first_part);
    segment.confidence = meanConfidence(state.parts, first_part, reference.size());
  }

  ChainModel model_;
  ChainLayout layout_;
  ObjectShape shape_;
  ObjectAppearance appearance_;
  cv::Size image_size_;
  int image_type_;
  ChainState state_;
  ChainState sought_;                         // around which the next frame is searched
  std::vector<double> initial_orientations_;  // of the parts
  std::vector<double> evidence_;              // of the parts
  int frames_lost_ = 0;
  PartCostsWorkspace cost_workspace_;
  TextureCostsWorkspace texture_workspace_;
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
