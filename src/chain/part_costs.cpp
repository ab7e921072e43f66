// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/part_costs.h"

#include <algorithm>
#include <cmath>

#include "chain_tracker/image/multiversion.h"
#include "chain_tracker/image/pixel_geometry.h"
#include "image/reused_plane.h"
#include "workers.h"

namespace chain_tracker {
namespace {

/// A code that a part's own window has.
struct LearnedCode {
  size_t code;
  float learned;      ///< root of its share in the part's window over the side of the windows
  const float* seen;  ///< roots of its counts in the windows of a row of states
};

/// costs[x] -= learned * seen[x]
inline void subtract(float learned, const float* __restrict seen, float* __restrict costs,
                     int columns) {
  for (int x = 0; x < columns; ++x) costs[x] -= learned * seen[x];
}

/// The same for three codes: the costs are loaded and stored once.
inline void subtract3(const LearnedCode* codes, const float* __restrict seen0,
                      const float* __restrict seen1, const float* __restrict seen2,
                      float* __restrict costs, int columns) {
  const float learned0 = codes[0].learned;
  const float learned1 = codes[1].learned;
  const float learned2 = codes[2].learned;
  for (int x = 0; x < columns; ++x) {
    costs[x] = costs[x] - learned0 * seen0[x] - learned1 * seen1[x] - learned2 * seen2[x];
  }
}

/// costs[x] = weight * sqrt(1 - sum of learned * seen[x])
CHAIN_TRACKER_MULTIVERSION
void computeCostRow(const LearnedCode* codes, size_t count, float weight, float* __restrict costs,
                    int columns) {
  for (int x = 0; x < columns; ++x) costs[x] = 1.0F;
  size_t i = 0;
  for (; i + 2 < count; i += 3) {
    subtract3(codes + i, codes[i].seen, codes[i + 1].seen, codes[i + 2].seen, costs, columns);
  }
  for (; i < count; ++i) subtract(codes[i].learned, codes[i].seen, costs, columns);
  for (int x = 0; x < columns; ++x) {
    costs[x] = weight * std::sqrt(costs[x] > 0.0F ? costs[x] : 0.0F);
  }
}

/// roots[x] = sqrt(counts[x])
CHAIN_TRACKER_MULTIVERSION
void takeRoots(const int* __restrict counts, float* __restrict roots, int columns) {
  for (int x = 0; x < columns; ++x) roots[x] = std::sqrt(static_cast<float>(counts[x]));
}

/// Codes of a part that fit on the stack.
constexpr size_t kFewCodes = 64;

/// A window's other codes do not touch the part's costs.
void markCodes(const RootHistogram& part, std::vector<bool>& wanted) {
  for (size_t code = 0; code < part.size(); ++code) {
    if (part[code] != 0.0F) wanted[code] = true;
  }
}

/// Counts the wanted codes in the windows on a lattice; no roots are taken of these yet.
void countWanted(FramePixels& pixels, Channel channel, const WindowLattice& lattice,
                 PartCostsWorkspace& workspace) {
  computeWindowHistograms(pixels, channel, lattice, workspace.wanted, workspace.counts,
                          workspace.histograms);
  workspace.roots.resize(workspace.counts.size());
  for (size_t code = 0; code < workspace.counts.size(); ++code) {
    if (!workspace.wanted[code]) continue;
    CodeRoots& roots = workspace.roots[code];
    reuse(roots.values, lattice.size);
    roots.taken.assign(static_cast<size_t>(lattice.size.height), cv::Range(0, 0));
  }
}

/// As many roots are taken at a time: a few more than are asked for take less time than a few.
constexpr int kRun = 16;

/// Roots of a row of counts from `wanted.start` on. Neighbouring parts have most windows in common,
/// and a root takes longer than all else that is done with a count: it is taken once.
const float* rootsOf(const cv::Mat1i& counts, int row, const cv::Range& wanted, CodeRoots& roots) {
  const int* const from = counts[row];
  float* const to = roots.values[row];
  cv::Range& taken = roots.taken[static_cast<size_t>(row)];
  if (wanted.start > taken.end || wanted.end < taken.start) taken = {wanted.start, wanted.start};
  if (wanted.start < taken.start) {
    takeRoots(from + wanted.start, to + wanted.start, taken.start - wanted.start);
    taken.start = wanted.start;
  }
  if (wanted.end > taken.end) {
    const int runs = (wanted.end - taken.end + kRun - 1) / kRun;
    const int columns = std::min(runs * kRun, counts.cols - taken.end);
    takeRoots(from + taken.end, to + taken.end, columns);
    taken.end += columns;
  }
  return to + wanted.start;
}

/// Rows of a lattice that are dealt to a worker.
struct DealtRows {
  int first = 0;  ///< in [0, every)
  int every = 1;

  /// The first of them that is no less than `row`.
  int from(int row) const { return row + (first - row % every + every) % every; }
};

/// In the rows of the lattice that are dealt. `side`: of the windows [px].
void computePartCost(const RootHistogram& part, const cv::Point& corner, int side, float weight,
                     const DealtRows& dealt, PartCostsWorkspace& workspace, cv::Mat1f& cost) {
  cv::AutoBuffer<LearnedCode, kFewCodes> codes(part.size());
  size_t count = 0;
  for (size_t code = 0; code < part.size(); ++code) {
    if (part[code] == 0.0F) continue;
    codes[count++] = {code, part[code] / static_cast<float>(side), nullptr};
  }
  const cv::Range columns(corner.x, corner.x + cost.cols);
  for (int row = dealt.from(corner.y); row < corner.y + cost.rows; row += dealt.every) {
    for (size_t i = 0; i < count; ++i) {
      const size_t code = codes[i].code;
      codes[i].seen = rootsOf(workspace.counts[code], row, columns, workspace.roots[code]);
    }
    computeCostRow(codes.data(), count, weight, cost[row - corner.y], cost.cols);
  }
}

/// A worker takes the roots of its rows, which no other one needs.
template <typename Work>
void onDealtRows(int threads, double steps, const Work& work) {
  const size_t workers = workersFor(threads, steps);
  onWorkers(workers, [&](size_t worker) {
    work(DealtRows{static_cast<int>(worker), static_cast<int>(workers)});
  });
}

}  // namespace

cv::Point2d CandidateGrid::originAround(const cv::Point2d& center) const {
  const cv::Point2d first = lattice.centerOf(0, 0);
  const double step = lattice.step;
  const cv::Point middle(states / 2);
  return first + cv::Point2d(std::round((center.x - first.x) / step) - middle.x,
                             std::round((center.y - first.y) / step) - middle.y) *
                     step;
}

void placeCandidateGrid(const std::vector<cv::Point2d>& centers, double side, int step,
                        double radius, CandidateGrid& grid) {
  const int window_cells = std::max(1, static_cast<int>(std::lround(side / step)));
  const int reach = std::max(1, static_cast<int>(std::ceil(radius / step)));
  const cv::Rect2d bounds = uprightBounds(centers);
  grid.states = {2 * reach + 1, 2 * reach + 1};
  grid.lattice.step = step;
  grid.lattice.window_cells = window_cells;
  // The window centred at the first candidate of the leftmost and topmost parts starts here.
  const double half = 0.5 * (window_cells * step - 1);
  grid.lattice.origin = {static_cast<int>(std::lround(bounds.x - half)) - reach * step,
                         static_cast<int>(std::lround(bounds.y - half)) - reach * step};
  const cv::Point2d first = grid.lattice.centerOf(0, 0);
  const auto corner = [&](double center, double first_center) {
    return std::max(0, static_cast<int>(std::lround((center - first_center) / step)) - reach);
  };
  grid.corners.clear();
  grid.lattice.size = {};
  for (const cv::Point2d& center : centers) {
    grid.corners.emplace_back(corner(center.x, first.x), corner(center.y, first.y));
  }
  for (const cv::Point& first_state : grid.corners) {
    grid.lattice.size.width = std::max(grid.lattice.size.width, first_state.x + grid.states.width);
    grid.lattice.size.height =
        std::max(grid.lattice.size.height, first_state.y + grid.states.height);
  }
}

void computePartCosts(FramePixels& pixels, Channel channel, const std::vector<RootHistogram>& parts,
                      const CandidateGrid& grid, double weight, std::vector<cv::Mat1f>& costs,
                      PartCostsWorkspace& workspace) {
  const bool is_sparse = grid.isSparse();
  std::vector<bool>& wanted = workspace.wanted;
  wanted.assign(static_cast<size_t>(pixels.codeCount(channel)), false);
  const int side = grid.lattice.window_cells * grid.lattice.step;
  if (!is_sparse) {
    for (const RootHistogram& part : parts) markCodes(part, wanted);
    countWanted(pixels, channel, grid.lattice, workspace);
  }
  costs.resize(parts.size());
  for (cv::Mat1f& cost : costs) cost.create(grid.states);
  const auto compute = [&](size_t k, const cv::Point& corner, const DealtRows& dealt) {
    computePartCost(parts[k], corner, side, static_cast<float>(weight), dealt, workspace, costs[k]);
  };
  const double states = grid.states.area();
  if (!is_sparse) {
    const double steps = states * static_cast<double>(parts.size());
    onDealtRows(workspace.threads, steps, [&](const DealtRows& dealt) {
      for (size_t k = 0; k < parts.size(); ++k) compute(k, grid.corners[k], dealt);
    });
    return;
  }
  for (size_t k = 0; k < parts.size(); ++k) {
    wanted.assign(wanted.size(), false);
    markCodes(parts[k], wanted);
    countWanted(pixels, channel, grid.latticeOf(k), workspace);
    onDealtRows(workspace.threads, states,
                [&](const DealtRows& dealt) { compute(k, cv::Point(0, 0), dealt); });
  }
}

RootHistogram learnPart(FramePixels& pixels, Channel channel, const cv::Point2d& center,
                        double side) {
  WindowLattice lattice;
  lattice.window_cells = std::max(1, static_cast<int>(std::lround(side)));
  const cv::Point2d corner = center - cv::Point2d(1.0, 1.0) * (0.5 * (lattice.window_cells - 1));
  lattice.origin = {cvFloor(corner.x), cvFloor(corner.y)};
  lattice.size = {2, 2};
  std::vector<cv::Mat1i> counts;
  WindowHistogramsWorkspace workspace;
  const std::vector<bool> all(static_cast<size_t>(pixels.codeCount(channel)), true);
  computeWindowHistograms(pixels, channel, lattice, all, counts, workspace);
  const auto right = static_cast<float>(corner.x - lattice.origin.x);
  const auto down = static_cast<float>(corner.y - lattice.origin.y);
  const auto area = static_cast<float>(lattice.window_cells * lattice.window_cells);
  RootHistogram histogram;
  for (const cv::Mat1i& count : counts) {
    const auto share = [&](int row, int column) {
      return static_cast<float>(count(row, column)) / area;
    };
    const float upper = (1.0F - right) * share(0, 0) + right * share(0, 1);
    const float lower = (1.0F - right) * share(1, 0) + right * share(1, 1);
    histogram.push_back(std::sqrt((1.0F - down) * upper + down * lower));
  }
  return histogram;
}

}  // namespace chain_tracker
