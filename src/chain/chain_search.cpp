// SPDX-License-Identifier: BSD-3-Clause
#include "chain_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "chain_nodes.h"
#include "length_evidence.h"
#include "robust_costs.h"
#include "state_motion.h"
#include "workers.h"

namespace chain_tracker {
namespace {

/// Cells of the coarse lattice along a part's window.
constexpr double kCellsPerWindow = 8.0;
/// Steps of the refined lattice in one of the coarse lattice, at most.
constexpr int kRefinedSteps = 4;
/// Cells left along a window when a wide search makes the lattice coarser.
constexpr double kFewestCells = 3.0;
/// Steps to each side in the widest search, which bounds its time: what is thin, and so has a fine
/// lattice, is not looked for all over the image.
constexpr double kWidestReach = 40.0;
/// Of the refinement around the coarse match [px]: the windows of the coarse lattice are rounded to
/// whole cells, which moves their optimum however fine the lattice is.
constexpr int kLeastReach = 4;
/// Of a cell of a grid, in what its chain alone would leave: the chain knows two of its neighbours,
/// the shape holds it on all sides. Calibrated on rendered scenes.
constexpr double kCellVariance = 0.25;
/// Of a window's place [px^2]: it covers whole pixels, wherever it should lie between them.
constexpr double kRoundingVariance = 1.0 / 12.0;
/// States along a side on which poses are refined: a vector's length.
constexpr int kPoseStates = 8;
/// Of the poses to the parts, and of the parts to the poses.
constexpr int kFits = 2;
/// Parts that are asked where the object may be, of all and of a segment: more take longer and tell
/// little more.
constexpr size_t kVoters = 16;
constexpr size_t kFewestVoters = 4;
/// Of the usual likeness: from which on a chain tells how the light has changed. It is lower than
/// what is trusted otherwise, as in another light all looks less as learned.
constexpr double kTellsLight = 0.6;
/// Share of an object outside the image from which on it is not seen: beyond the border its pixels
/// go on, as if they showed more of it.
constexpr double kMostOutside = 0.9;
/// Of lengthEvidence(): from which on the two ends of a line can be told from one another.
constexpr double kTellsPlace = 0.5;

void takePoses(const ChainState& state, std::vector<SegmentPose>& poses) {
  poses.clear();
  for (const SegmentState& segment : state.segments) {
    poses.push_back({segment.image_from_segment.angle, segment.image_from_segment.scale});
  }
}

/// An eighth of a window, or coarser where a wide search would have too many candidates.
int coarseStep(double side, const SearchRange& range) {
  const double fine = side / kCellsPerWindow;
  const double affordable =
      std::min(2.0 * range.radius / range.most_candidates, side / kFewestCells);
  return std::max(1, static_cast<int>(std::lround(std::max(fine, affordable))));
}

/// Of the part's window.
double shareOutside(const PartState& part, const cv::Rect2d& image) {
  const cv::Point2d half(0.5 * part.side, 0.5 * part.side);
  const cv::Rect2d window(part.position - half, part.position + half);
  return 1.0 - (window & image).area() / window.area();
}

void interpolatePoses(const std::vector<PoseGrid>& grids, const ChainMatch& match,
                      std::vector<SegmentPose>& poses) {
  poses.clear();
  for (size_t m = 0; m < grids.size(); ++m) {
    poses.push_back(interpolatePose(grids[m], match.segments[m].energies));
  }
}

}  // namespace

void forget(FoundChain& found) {
  found.state.confidence = found.likeness = found.expected_likeness = 0.0;
}

ChainSearch::ChainSearch(const ChainModel& model, const cv::Mat& image, const ChainLayout& layout,
                         const ChainState& initial)
    : model_(model),
      layout_(layout.segments),
      appearance_(model.appearance, image, layout, initial),
      image_(cv::Point2d(-0.5, -0.5), cv::Size2d(image.size())),
      expectations_(appearance_.learned(), appearance_.model(), initial.parts.size()),
      overlaps_(initial.parts),
      joint_memory_(initial),
      springs_(model, layout.segments),
      placement_search_(model.appearance, image.size()),
      pose_fits_(model.segments, layout.segments, lengthRates(initial)),
      line_alignment_(layout.segments.front(), model.appearance, image.size()),
      wide_(layout.segments.size()),
      narrow_(layout.segments.size()),
      fine_(layout.segments.size()),
      middles_(layout.segments.size()),
      centers_(layout.segments.size()) {
  is_clearly_marked_ = chain_tracker::isClearlyMarked(colorsOf(initial.segments.front()));
  for (const SegmentLayout& segment : layout_) {
    variance_shares_.insert(variance_shares_.end(), segment.parts.size(),
                            isGrid(segment.layout) ? kCellVariance : 1.0);
  }
}

std::vector<double> ChainSearch::lengthRates(const ChainState& initial) {
  std::vector<double> rates;
  for (size_t m = 0; m < segments(); ++m) {
    // The joints of a link tell its length, whatever it looks like.
    const bool is_link = layout_[m].entry || layout_[m].exit;
    rates.push_back(is_link ? 1.0 : lengthEvidence(colorsOf(initial.segments[m])));
  }
  return rates;
}

/// Of the parts of a segment that the first frame shows.
std::vector<RootHistogram> ChainSearch::colorsOf(const SegmentState& initial) {
  const auto first = static_cast<size_t>(initial.first_part);
  std::vector<RootHistogram> colors;
  for (size_t k = first; k < first + static_cast<size_t>(initial.part_count); ++k) {
    const PartAppearance& learned = appearance_.learned().part(k, 0.0);
    if (learned.known >= 1.0F) colors.push_back(learned.colors);
  }
  return colors;
}

bool ChainSearch::isUniform() const { return pose_fits_.lengthRate(0) < kTellsPlace; }

void ChainSearch::observe(const FoundChain& found) {
  expectations_.observe(found.state.parts, found.likeness);
  joint_memory_.observe(found.state, expectations_.usualConfidence());
  appearance_.keepLight();
  const bool tells_light = found.likeness >= kTellsLight * expectations_.usualLikeness();
  if (tells_light) appearance_.observeLight(found.state);
}

void ChainSearch::useThreads(int threads) {
  threads_ = threads;
  wide_.workspace.threads = narrow_.workspace.threads = pose_workspace_.threads = threads;
  appearance_.useThreads(threads);
  placement_search_.useThreads(threads);
}

void ChainSearch::find(const ChainState& sought, const SearchRange& range, FoundChain& found) {
  sought_ = sought;
  takePoses(sought, previous_);
  range_ = range;
  coarse_ = range.is_narrow ? &narrow_ : &wide_;
  springs_.relax(sought, range.looseness, layout_);
  found.state = sought;
  forget(found);
  lookCoarsely();
  const ChainMatch& match =
      matched(coarse_->candidates.poses, coarse_->candidates.segments, coarse_->workspace);
  if (!match.found()) return;
  keepEdgeCosts(match);
  lookFinely(match);
  const ChainMatch& finest = matchFinePoses();
  if (finest.found()) {
    interpolatePoses(fine_.poses, finest, poses_);
    settle(found);
  }
}

void ChainSearch::findAnywhere(const ChainState& sought, double reach, const SearchRange& range,
                               FoundChain& found) {
  const Linkage links = linkageOf(sought);
  findMoved(sought,
            placement_search_.find(links.segments, links.hinges, reach, appearance_.pixels()),
            range, found);
}

void ChainSearch::findHung(const ChainState& sought, const std::vector<bool>& seen,
                           const SearchRange& range, FoundChain& found) {
  Linkage links = linkageOf(sought);
  // What is looked for at all angles is believed to have left its rest.
  for (Hinge& hinge : links.hinges) hinge.rest = JointRest();
  findMoved(sought,
            placement_search_.hang(links.segments, links.hinges, seen, appearance_.pixels()), range,
            found);
}

bool ChainSearch::alignLine(ChainState& line) {
  const double side = sideOf(0, line.segments.front().image_from_segment.scale);
  return line_alignment_.align(votersOf(line, 0, line.parts.size()), side, isUniform(),
                               appearance_.pixels(), line);
}

ChainSearch::Linkage ChainSearch::linkageOf(const ChainState& state) {
  std::vector<SegmentPose> poses;
  takePoses(state, poses);
  Linkage links;
  for (size_t m = 0; m < segments(); ++m) {
    const size_t wanted = std::max(kFewestVoters, kVoters / segments());
    links.segments.push_back({votersOf(state, m, wanted), sideOf(m, poses[m].scale), poses[m]});
    if (m == 0) continue;
    links.hinges.push_back({jointPosition(layout_, state, m - 1), jointOf(model_, m - 1),
                            joint_memory_.rests()[m - 1]});
  }
  return links;
}

void ChainSearch::findMoved(const ChainState& sought, const std::vector<Similarity>& motions,
                            const SearchRange& range, FoundChain& found) {
  ChainState moved = sought;
  for (size_t m = 0; m < segments(); ++m) moveSegment(motions[m], m, moved);
  find(moved, range, found);
}

/// Every so many parts, from end to end, that at most `wanted` are asked.
std::vector<Voter> ChainSearch::votersOf(const ChainState& state, size_t m, size_t wanted) {
  const size_t parts = layout_[m].parts.size();
  const size_t every = (parts + wanted - 1) / wanted;
  const auto first = static_cast<size_t>(state.segments[m].first_part);
  std::vector<Voter> voters;
  for (size_t k = 0; k < parts; k += every) {
    const size_t part = first + k;
    const PartAppearance& learned = appearance_.lookOf(state, part);
    voters.push_back({state.parts[part].position, learned.colors,
                      expectations_.colorOutlierCost(part, model_.appearance.outlier_below),
                      learned.known});
  }
  return voters;
}

double ChainSearch::sideOf(size_t m, double scale) const {
  return layout_[m].parts.front().side * scale;
}

double ChainSearch::smallestSide(const std::vector<SegmentPose>& poses) const {
  double smallest = sideOf(0, poses[0].scale);
  for (size_t m = 1; m < segments(); ++m) {
    smallest = std::min(smallest, sideOf(m, poses[m].scale));
  }
  return smallest;
}

/// Around where the nodes are believed to be.
void ChainSearch::lookCoarsely() {
  for (size_t m = 0; m < segments(); ++m) takeNodePositions(layout_, sought_, m, centers_[m]);
  const int step = coarseStep(smallestSide(previous_), range_);
  const double radius = std::min(range_.radius, kWidestReach * step);
  lookAround(previous_, step, radius, SearchStage::kCoarse, coarse_->candidates);
  robustify(coarse_->candidates);
  for (size_t m = 0; m < segments(); ++m) {
    const SegmentModel& model = model_.segments[m];
    coarse_->candidates.poses[m] = {previous_[m], model.orientation_hypotheses,
                                    model.orientation_step, model.scale_hypotheses,
                                    model.scale_step};
  }
}

/// Up to a coarse step around the coarse match.
void ChainSearch::lookFinely(const ChainMatch& coarse_match) {
  interpolatePoses(coarse_->candidates.poses, coarse_match, poses_);
  for (size_t m = 0; m < segments(); ++m) {
    const std::vector<cv::Point>& states = coarse_match.segments[m].states;
    centers_[m].clear();
    for (size_t k = 0; k < states.size(); ++k) {
      centers_[m].push_back(coarse_->candidates.segments[m].positionOf(k, cv::Point2d(states[k])));
    }
  }
  const int coarse_step = coarse_->candidates.segments.front().step;
  const int step = (coarse_step + kRefinedSteps - 1) / kRefinedSteps;
  const int reach = std::max(kLeastReach, coarse_step + step);
  lookAround(poses_, step, reach, SearchStage::kFine, fine_);
  for (size_t m = 0; m < segments(); ++m) {
    fine_.poses[m] = finePoses(model_.segments[m], poses_[m]);
  }
}

/// Makes `candidates` those around `centers_`, with what they cost.
void ChainSearch::lookAround(const std::vector<SegmentPose>& poses, int step, double radius,
                             SearchStage stage, Candidates& candidates) {
  for (size_t m = 0; m < segments(); ++m) {
    const SegmentLayout& segment = layout_[m];
    const auto first = centers_[m].begin() + (segment.entry ? 1 : 0);
    part_centers_.assign(first, first + static_cast<int>(segment.parts.size()));
    placeCandidateGrid(part_centers_, sideOf(m, poses[m].scale), step, radius, candidates.grids[m]);
    placeCandidates(segment, candidates.grids[m], centers_[m].back(), candidates.segments[m]);
    if (m > 0) {
      candidates.segments[m].origins.front() = candidates.segments[m - 1].origins.back();
    }
    const double turn = wrapAngle(poses[m].orientation - previous_[m].orientation);
    appearance_.compute(sought_, m, turn, candidates.grids[m], stage, candidates.costs[m]);
    joinCosts(m, candidates);
  }
}

/// Of the parts and of the joints at the segment's ends.
void ChainSearch::joinCosts(size_t m, Candidates& candidates) const {
  const SegmentLayout& segment = layout_[m];
  const std::vector<cv::Mat1f>& parts = candidates.costs[m].parts;
  std::vector<cv::Mat1f>& costs = candidates.segments[m].costs;
  const cv::Size& states = candidates.grids[m].states;
  if (candidates.joint_costs.size() != states) candidates.joint_costs = cv::Mat1f::zeros(states);
  costs.clear();
  if (segment.entry) costs.push_back(candidates.joint_costs);
  costs.insert(costs.end(), parts.begin(), parts.end());
  if (segment.exit) costs.push_back(candidates.joint_costs);
}

/// Of all parts where the chain has them.
void ChainSearch::keepEdgeCosts(const ChainMatch& coarse_match) {
  edge_costs_.clear();
  for (size_t m = 0; m < segments(); ++m) {
    const size_t joint = layout_[m].entry ? 1 : 0;
    const std::vector<cv::Mat1f>& costs = coarse_->candidates.costs[m].edges;
    for (size_t k = 0; k < layout_[m].parts.size(); ++k) {
      const cv::Point& state = coarse_match.segments[m].states[joint + k];
      edge_costs_.push_back(costs.empty() ? 0.0 : costs[k](state));
    }
  }
}

/// Of the coarse stage alone: the fine one looks around the parts, where nothing else is near
/// enough to pull them about, and where they were must not pull them back.
void ChainSearch::robustify(Candidates& candidates) const {
  const AppearanceModel& model = model_.appearance;
  for (size_t m = 0; m < segments(); ++m) {
    const CandidateGrid& grid = candidates.grids[m];
    const size_t joint = layout_[m].entry ? 1 : 0;
    const auto soften = [&](size_t k, size_t /*worker*/) {
      const size_t part = static_cast<size_t>(sought_.segments[m].first_part) + k;
      cv::Mat1f& costs = candidates.segments[m].costs[joint + k];
      softenCosts(expectations_.outlierCost(part, model.outlier_below), model.outlier_slope, costs);
      if (range_.travel_weight > 0.0) {
        addTravelCosts(grid.positionOf(k, {0.0, 0.0}), grid.lattice.step,
                       sought_.parts[part].position, range_.travel_weight, costs);
      }
    };
    shareOut(threads_, layout_[m].parts.size(), grid.states.area(), soften);
  }
}

const ChainMatch& ChainSearch::matched(const std::vector<PoseGrid>& poses,
                                       const std::vector<SegmentCandidates>& candidates,
                                       ChainMatcherWorkspace& workspace) const {
  return matchChain({layout_, model_, previous_, joint_memory_.rests(), poses, candidates},
                    workspace);
}

const ChainMatch& ChainSearch::matchFinePoses() {
  for (size_t m = 0; m < segments(); ++m) {
    takeMiddleStates(fine_.segments[m], kPoseStates, middles_[m]);
  }
  return matched(fine_.poses, middles_, pose_workspace_);
}

/// The parts tell the poses more exactly than the energies of a few poses do, but their springs
/// hold them near the poses these were laid for: so they are laid once more.
void ChainSearch::settle(FoundChain& found) {
  for (int i = 0; i < kFits; ++i) {
    const std::vector<RefinedPart>& parts =
        refineChain(layout_, poses_, fine_.segments, fine_workspace_);
    if (parts.empty()) return;
    fillIn(parts, found.state);
    compare(parts, found);
    takePoses(found.state, poses_);
  }
}

/// With what was learned.
void ChainSearch::compare(const std::vector<RefinedPart>& refined, FoundChain& found) {
  const std::vector<PartState>& parts = found.state.parts;
  costs_ = edge_costs_;
  for (size_t k = 0; k < refined.size(); ++k) costs_[k] += refined[k].appearance;
  overlaps_.computeShares(parts, shares_);
  outside_.clear();
  for (const PartState& part : parts) outside_.push_back(shareOutside(part, image_));
  found.likeness = expectations_.likeness(costs_, shares_);
  found.expected_likeness = expectations_.expectedLikeness(found.likeness, shares_, outside_);
  const double outside = std::accumulate(outside_.begin(), outside_.end(), 0.0);
  if (outside > kMostOutside * static_cast<double>(parts.size())) forget(found);
}

/// The parts were found under `poses_`.
void ChainSearch::fillIn(const std::vector<RefinedPart>& parts, ChainState& found) {
  for (size_t k = 0; k < parts.size(); ++k) {
    PartState& part = found.parts[k];
    part.position = parts[k].position;
    part.covariance =
        parts[k].covariance * variance_shares_[k] + kRoundingVariance * cv::Matx22d::eye();
    part.confidence = expectations_.confidence(k, parts[k].appearance);
    part.visible = part.confidence >= model_.search.occluded_below;
  }
  found.confidence = expectations_.meanConfidence(found.parts, 0, parts.size());
  for (size_t m = 0; m < segments(); ++m) {
    SegmentState& segment = found.segments[m];
    segment.confidence = expectations_.meanConfidence(
        found.parts, static_cast<size_t>(segment.first_part), layout_[m].parts.size());
  }
  pose_fits_.fit(poses_, expectations_.usualConfidence(), found);
}

}  // namespace chain_tracker
