// SPDX-License-Identifier: BSD-3-Clause
#include "voter_costs.h"

#include <algorithm>

#include "robust_costs.h"
#include "workers.h"

namespace chain_tracker {

std::vector<cv::Mat1f> voterCosts(const std::vector<Voter>& voters, double side,
                                  const CellMap& cells, const AppearanceModel& model,
                                  FramePixels& pixels, PartCostsWorkspace& workspace) {
  CandidateGrid grid;
  grid.lattice.step = cells.step;
  grid.lattice.window_cells = std::max(1, cvRound(side / cells.step));
  const double half = 0.5 * (grid.lattice.window_cells * cells.step - 1);
  grid.lattice.origin = cells.first - cv::Point2d(half, half);
  grid.lattice.size = grid.states = cells.size;
  grid.corners.resize(voters.size());
  std::vector<RootHistogram> colors;
  colors.reserve(voters.size());
  for (const Voter& voter : voters) colors.push_back(voter.colors);
  std::vector<cv::Mat1f> costs;
  computePartCosts(pixels, Channel::kColors, colors, grid, model.weight, costs, workspace);
  const auto soften = [&](size_t k, size_t /*worker*/) {
    costs[k] *= voters[k].known;
    softenCosts(voters[k].outlier_cost, model.outlier_slope, costs[k]);
  };
  shareOut(workspace.threads, voters.size(), cells.size.area(), soften);
  return costs;
}

double costAt(const cv::Point2d& position, size_t k, const std::vector<Voter>& voters,
              const CellMap& cells, const std::vector<cv::Mat1f>& costs) {
  const cv::Point cell = cells.cellOf(position);
  return cells.contain(cell) ? costs[k](cell) : voters[k].outlier_cost;
}

}  // namespace chain_tracker
