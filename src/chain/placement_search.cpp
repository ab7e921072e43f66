// SPDX-License-Identifier: BSD-3-Clause
#include "placement_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "state_motion.h"
#include "workers.h"

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

/// Where the segments are looked for.
struct Region {
  CellMap cells;
  cv::Rect middles;  ///< where the middle of a segment may be, so that all of it is on the map
};

/// All that the segments cover if one of them is within `radius` of where they were.
Region regionAround(const std::vector<RigidSegment>& segments, double radius,
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
  const cv::Rect2d within = cv::Rect2d(bounds.tl() - corner, bounds.br() + corner) & image;
  const double span = std::max(within.width, within.height) + 2.0 * reach;
  Region region;
  CellMap& cells = region.cells;
  cells.step = std::max(1, cvRound(std::max(smallest / kCellsPerWindow, span / kMostCells)));
  const int margin = cvCeil(reach / cells.step) + 1;
  region.middles = {margin, margin, cvFloor(within.width / cells.step) + 1,
                    cvFloor(within.height / cells.step) + 1};
  cells.first = within.tl() - cv::Point2d(margin, margin) * cells.step;
  cells.size = region.middles.size() + cv::Size(2 * margin, 2 * margin);
  return region;
}

int turnsFor(const std::vector<RigidSegment>& segments, int step) {
  const double way = 2.0 * CV_PI * reachOf(segments) / step;
  return cvCeil(std::clamp(way / kCellsPerTurn, kFewestTurns, kMostTurns));
}

Placement cheapestOfTurn(int turn, const Similarity& rotation, const std::vector<cv::Mat1f>& costs,
                         const std::vector<cv::Point2d>& offsets, const cv::Rect& middles,
                         cv::Mat1f& sums) {
  sums.create(middles.size());
  sums = 0.0F;
  for (size_t k = 0; k < costs.size(); ++k) {
    const cv::Point offset(rotation.apply(offsets[k]));
    cv::add(sums, costs[k](middles + offset), sums);
  }
  Placement cheapest{turn, {}, 0.0};
  cv::minMaxLoc(sums, &cheapest.cost, nullptr, &cheapest.middle);
  cheapest.middle += middles.tl();
  return cheapest;
}

/// Segments placed one after the other, from one that is placed freely outwards.
class ChainPlacement {
 public:
  ChainPlacement(const std::vector<RigidSegment>& segments, const std::vector<Hinge>& hinges,
                 const Region& region, const std::vector<std::vector<cv::Mat1f>>& costs, int turns,
                 int threads)
      : segments_(segments),
        hinges_(hinges),
        cells_(region.cells),
        middles_(region.middles),
        costs_(costs),
        turns_(turns),
        threads_(threads),
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
    const Placement best = cheapestPlacement(costs_[m], offsets, middles_, turns_, threads_);
    motions_[m] = rigidMotion(angleOf(best.turn), middle, cells_.centerOf(best.middle));
  }

  double costOf(size_t m, const Similarity& motion) const {
    const std::vector<Voter>& voters = segments_[m].voters;
    double cost = 0.0;
    for (size_t k = 0; k < voters.size(); ++k) {
      cost += costAt(motion.apply(voters[k].position), k, voters, cells_, costs_[m]);
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
  const CellMap& cells_;
  const cv::Rect& middles_;
  const std::vector<std::vector<cv::Mat1f>>& costs_;
  int turns_;
  int threads_;
  std::vector<Similarity> motions_;
};

}  // namespace

Placement cheapestPlacement(const std::vector<cv::Mat1f>& costs,
                            const std::vector<cv::Point2d>& offsets, const cv::Rect& middles,
                            int turns, int threads) {
  std::vector<Placement> cheapest(static_cast<size_t>(turns));
  std::vector<cv::Mat1f> sums(static_cast<size_t>(threads));
  const auto place = [&](size_t turn, size_t worker) {
    const Similarity rotation{2.0 * CV_PI * static_cast<double>(turn) / turns, 1.0, {}};
    cheapest[turn] =
        cheapestOfTurn(static_cast<int>(turn), rotation, costs, offsets, middles, sums[worker]);
  };
  const double steps = static_cast<double>(costs.size()) * middles.area();
  shareOut(threads, cheapest.size(), steps, place);
  const auto is_cheaper = [](const Placement& a, const Placement& b) { return a.cost < b.cost; };
  return *std::min_element(cheapest.begin(), cheapest.end(), is_cheaper);
}

std::vector<Similarity> PlacementSearch::find(const std::vector<RigidSegment>& segments,
                                              const std::vector<Hinge>& hinges, double radius,
                                              FramePixels& pixels) {
  const Region region = regionAround(segments, radius, image_);
  std::vector<std::vector<cv::Mat1f>> costs;
  costs.reserve(segments.size());
  for (const RigidSegment& segment : segments) {
    costs.push_back(
        voterCosts(segment.voters, segment.side, region.cells, model_, pixels, workspace_));
  }
  ChainPlacement placement(segments, hinges, region, costs, turnsFor(segments, region.cells.step),
                           workspace_.threads);
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
  const Region region = regionAround(segments, swing, image_);
  std::vector<std::vector<cv::Mat1f>> costs(segments.size());
  for (size_t m = 0; m < segments.size(); ++m) {
    if (seen[m]) continue;
    costs[m] =
        voterCosts(segments[m].voters, segments[m].side, region.cells, model_, pixels, workspace_);
  }
  ChainPlacement placement(segments, hinges, region, costs, kFineTurns, workspace_.threads);
  placement.hangUnseen(seen);
  return placement.motions();
}

}  // namespace chain_tracker
