// SPDX-License-Identifier: BSD-3-Clause
#include "placement_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "robust_costs.h"
#include "state_motion.h"

namespace chain_tracker {
namespace {

/// Cells along the smallest window.
constexpr double kCellsPerWindow = 3.0;
/// Cells along the region, at most: bounds the time.
constexpr double kMostCells = 160.0;
/// By which the farthest part of a segment moves from one turn to the next.
constexpr double kCellsPerTurn = 3.0;
constexpr double kFewestTurns = 16.0;
constexpr double kMostTurns = 128.0;
/// Of segments that hang where the others stay: each turn asks few cells.
constexpr int kFineTurns = 128;
/// Of a joint by a half turn, of what the segment behind it costs if all hidden: links that look
/// alike must not fold onto one another.
constexpr double kBendCost = 0.3;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

cv::Point2d middleOf(const RigidSegment& segment) {
  cv::Point2d middle;
  for (const Voter& voter : segment.voters) {
    middle += voter.position / static_cast<double>(segment.voters.size());
  }
  return middle;
}

/// The farthest that a part is from the middle of its segment [px].
double reachOf(const std::vector<RigidSegment>& segments) {
  double reach = 0.0;
  for (const RigidSegment& segment : segments) {
    const cv::Point2d middle = middleOf(segment);
    for (const Voter& voter : segment.voters) {
      reach = std::max(reach, cv::norm(voter.position - middle));
    }
  }
  return reach;
}

/// Where the centres of windows may be.
struct Cells {
  cv::Point2d first;  ///< centre of cell (0, 0) [px]
  int step = 1;       ///< [px]
  cv::Size size;
  cv::Rect middles;  ///< where the middle of a segment may be, so that all of it is on the map

  cv::Point cellOf(const cv::Point2d& position) const { return (position - first) / step; }
  cv::Point2d centerOf(const cv::Point& cell) const { return first + cv::Point2d(cell) * step; }
  bool contain(const cv::Point& cell) const { return cv::Rect(cv::Point(), size).contains(cell); }
};

/// All that the segments cover if one of them is within `radius` of where they were.
Cells cellsAround(const std::vector<RigidSegment>& segments, double radius,
                  const cv::Rect2d& image) {
  std::vector<cv::Point2d> middles;
  double smallest = kInfinity;
  for (const RigidSegment& segment : segments) {
    const cv::Point2d middle = middleOf(segment);
    middles.emplace_back(std::clamp(middle.x, 0.0, image.width - 1.0),
                         std::clamp(middle.y, 0.0, image.height - 1.0));
    smallest = std::min(smallest, segment.side);
  }
  const double reach = reachOf(segments);
  const cv::Rect2d bounds = uprightBounds(middles);
  const cv::Point2d corner(radius, radius);
  const cv::Rect2d region = cv::Rect2d(bounds.tl() - corner, bounds.br() + corner) & image;
  const double span = std::max(region.width, region.height) + 2.0 * reach;
  Cells cells;
  cells.step = std::max(1, cvRound(std::max(smallest / kCellsPerWindow, span / kMostCells)));
  const int margin = cvCeil(reach / cells.step) + 1;
  cells.middles = {margin, margin, cvFloor(region.width / cells.step) + 1,
                   cvFloor(region.height / cells.step) + 1};
  cells.first = region.tl() - cv::Point2d(margin, margin) * cells.step;
  cells.size = cells.middles.size() + cv::Size(2 * margin, 2 * margin);
  return cells;
}

int turnsFor(const std::vector<RigidSegment>& segments, int step) {
  const double way = 2.0 * CV_PI * reachOf(segments) / step;
  return cvCeil(std::clamp(way / kCellsPerTurn, kFewestTurns, kMostTurns));
}

/// Of the segment's voters.
std::vector<cv::Mat1f> costsOf(const RigidSegment& segment, const Cells& cells,
                               const AppearanceModel& model, FramePixels& pixels,
                               PartCostsWorkspace& workspace) {
  const std::vector<Voter>& voters = segment.voters;
  CandidateGrid grid;
  grid.lattice.step = cells.step;
  grid.lattice.window_cells = std::max(1, cvRound(segment.side / cells.step));
  const double half = 0.5 * (grid.lattice.window_cells * cells.step - 1);
  grid.lattice.origin = cells.first - cv::Point2d(half, half);
  grid.lattice.size = grid.states = cells.size;
  grid.corners.resize(voters.size());
  std::vector<RootHistogram> colors;
  colors.reserve(voters.size());
  for (const Voter& voter : voters) colors.push_back(voter.colors);
  std::vector<cv::Mat1f> costs;
  computePartCosts(pixels, Channel::kColors, colors, grid, model.weight, costs, workspace);
  for (size_t k = 0; k < voters.size(); ++k) {
    costs[k] *= voters[k].known;
    softenCosts(voters[k].outlier_cost, model.outlier_slope, costs[k]);
  }
  return costs;
}

/// Segments placed one after the other, from one that is placed freely outwards.
class ChainPlacement {
 public:
  ChainPlacement(const std::vector<RigidSegment>& segments, const std::vector<Hinge>& hinges,
                 const Cells& cells, const std::vector<std::vector<cv::Mat1f>>& costs, int turns)
      : segments_(segments),
        hinges_(hinges),
        cells_(cells),
        costs_(costs),
        turns_(turns),
        motions_(segments.size()) {}

  /// Returns the cost of all.
  double placeAround(size_t anchor) {
    placeFreely(anchor);
    double cost = costOf(anchor, motions_[anchor]);
    for (size_t m = anchor + 1; m < segments_.size(); ++m) cost += hang(m, m - 1, hinges_[m - 1]);
    for (size_t m = anchor; m-- > 0;) cost += hang(m, m + 1, hinges_[m]);
    return cost;
  }

  void hangUnseen(const std::vector<bool>& seen) {
    const auto first = std::find(seen.begin(), seen.end(), true) - seen.begin();
    const auto anchor = static_cast<size_t>(first);
    for (size_t m = anchor + 1; m < segments_.size(); ++m) {
      if (!seen[m]) hang(m, m - 1, hinges_[m - 1]);
    }
    for (size_t m = anchor; m-- > 0;) hang(m, m + 1, hinges_[m]);
  }

  const std::vector<Similarity>& motions() const { return motions_; }

 private:
  double angleOf(int turn) const { return wrapAngle(2.0 * CV_PI * turn / turns_); }

  void placeFreely(size_t m) {
    const cv::Point2d middle = middleOf(segments_[m]);
    std::vector<cv::Point2d> offsets;
    for (const Voter& voter : segments_[m].voters) {
      offsets.push_back((voter.position - middle) / cells_.step);
    }
    const Placement best = cheapestPlacement(costs_[m], offsets, cells_.middles, turns_);
    motions_[m] = rigidMotion(angleOf(best.turn), middle, cells_.centerOf(best.middle));
  }

  /// A voter off the map is hidden.
  double costOf(size_t m, const Similarity& motion) const {
    double cost = 0.0;
    for (size_t k = 0; k < segments_[m].voters.size(); ++k) {
      const Voter& voter = segments_[m].voters[k];
      const cv::Point cell = cells_.cellOf(motion.apply(voter.position));
      cost += cells_.contain(cell) ? costs_[m][k](cell) : voter.outlier_cost;
    }
    return cost;
  }

  /// From the segment `from`, at the angle that costs least; returns that cost.
  double hang(size_t m, size_t from, const Hinge& hinge) {
    double hidden = 0.0;
    for (const Voter& voter : segments_[m].voters) hidden += voter.outlier_cost;
    const cv::Point2d joint = motions_[from].apply(hinge.position);
    double least = kInfinity;
    for (int turn = 0; turn < turns_; ++turn) {
      const double bend = angleOf(turn);
      const Similarity motion =
          rigidMotion(wrapAngle(motions_[from].angle + bend), hinge.position, joint);
      const double cost = costOf(m, motion) + kBendCost * hidden * std::abs(bend) / CV_PI +
                          jointCosts(m, motion.angle, from, hinge);
      if (cost >= least) continue;
      least = cost;
      motions_[m] = motion;
    }
    return least;
  }

  double jointCosts(size_t m, double turn, size_t from, const Hinge& hinge) const {
    SegmentPose hung = segments_[m].pose;
    SegmentPose other = segments_[from].pose;
    hung.orientation += turn;
    other.orientation += motions_[from].angle;
    if (m < from) std::swap(hung, other);
    return jointCost(hinge.limits, other, hung) + restCost(hinge.rest, other, hung);
  }

  const std::vector<RigidSegment>& segments_;
  const std::vector<Hinge>& hinges_;
  const Cells& cells_;
  const std::vector<std::vector<cv::Mat1f>>& costs_;
  int turns_;
  std::vector<Similarity> motions_;
};

}  // namespace

Placement cheapestPlacement(const std::vector<cv::Mat1f>& costs,
                            const std::vector<cv::Point2d>& offsets, const cv::Rect& middles,
                            int turns) {
  Placement best;
  double least = kInfinity;
  cv::Mat1f sums(middles.size());
  for (int turn = 0; turn < turns; ++turn) {
    const Similarity rotation{2.0 * CV_PI * turn / turns, 1.0, {}};
    sums = 0.0F;
    for (size_t k = 0; k < costs.size(); ++k) {
      const cv::Point offset(rotation.apply(offsets[k]));
      cv::add(sums, costs[k](middles + offset), sums);
    }
    double cost = 0.0;
    cv::Point cheapest;
    cv::minMaxLoc(sums, &cost, nullptr, &cheapest);
    if (cost >= least) continue;
    least = cost;
    best = {turn, middles.tl() + cheapest};
  }
  return best;
}

std::vector<Similarity> PlacementSearch::find(const std::vector<RigidSegment>& segments,
                                              const std::vector<Hinge>& hinges, double radius,
                                              FramePixels& pixels) {
  const Cells cells = cellsAround(segments, radius, image_);
  std::vector<std::vector<cv::Mat1f>> costs;
  costs.reserve(segments.size());
  for (const RigidSegment& segment : segments) {
    costs.push_back(costsOf(segment, cells, model_, pixels, workspace_));
  }
  ChainPlacement placement(segments, hinges, cells, costs, turnsFor(segments, cells.step));
  std::vector<Similarity> best;
  double least = kInfinity;
  for (size_t anchor = 0; anchor < segments.size(); ++anchor) {
    const double cost = placement.placeAround(anchor);
    if (cost >= least) continue;
    least = cost;
    best = placement.motions();
  }
  return best;
}

std::vector<Similarity> PlacementSearch::hang(const std::vector<RigidSegment>& segments,
                                              const std::vector<Hinge>& hinges,
                                              const std::vector<bool>& seen, FramePixels& pixels) {
  double swing = 0.0;
  for (size_t m = 0; m < segments.size(); ++m) {
    if (!seen[m]) swing += 2.0 * reachOf({segments[m]}) + segments[m].side;
  }
  const Cells cells = cellsAround(segments, swing, image_);
  std::vector<std::vector<cv::Mat1f>> costs(segments.size());
  for (size_t m = 0; m < segments.size(); ++m) {
    if (!seen[m]) costs[m] = costsOf(segments[m], cells, model_, pixels, workspace_);
  }
  ChainPlacement placement(segments, hinges, cells, costs, kFineTurns);
  placement.hangUnseen(seen);
  return placement.motions();
}

}  // namespace chain_tracker
