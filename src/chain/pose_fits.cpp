// SPDX-License-Identifier: BSD-3-Clause
#include "pose_fits.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace chain_tracker {
namespace {

/// Of the usual confidence: from which on a link shows its size. If one does not, none rescales by
/// more than so much of what it may, unless all are seen at least so well and grow.
constexpr double kShowsSize = 0.8;
constexpr double kUnsureScaling = 0.25;
constexpr double kShowsGrowth = 0.6;

bool areAllSure(const std::vector<SegmentState>& segments, double confidence) {
  return std::all_of(segments.begin(), segments.end(),
                     [=](const SegmentState& segment) { return segment.confidence >= confidence; });
}

}  // namespace

PoseGrid finePoses(const SegmentModel& model, const SegmentPose& coarse) {
  const auto fine_step = [](int hypotheses, double step) {
    return hypotheses > 1 ? 0.5 * step : step;
  };
  return {coarse, std::min(3, model.orientation_hypotheses),
          fine_step(model.orientation_hypotheses, model.orientation_step),
          std::min(3, model.scale_hypotheses), fine_step(model.scale_hypotheses, model.scale_step)};
}

PoseFits::PoseFits(const std::vector<SegmentModel>& models,
                   const std::vector<SegmentLayout>& layout, std::vector<double> length_rates)
    : models_(models), layout_(layout), length_rates_(std::move(length_rates)) {}

/// A link that is hidden seems as long as whatever it is found on, and pulls its neighbours along:
/// some shrink then. All grow where the object comes nearer faster than the fits have followed.
void PoseFits::fit(const std::vector<SegmentPose>& poses, double usual_confidence,
                   ChainState& found) {
  fitAll(poses, 1.0, found);
  const bool is_chain = layout_.size() > 1;
  if (!is_chain || areAllSure(found.segments, kShowsSize * usual_confidence)) return;
  const bool may_grow = areAllSure(found.segments, kShowsGrowth * usual_confidence);
  const double growth = may_grow ? leastGrowth(poses, found) : 0.0;
  fitAll(poses, std::max(kUnsureScaling, growth), found);
}

/// `scaling`: of how much a link may rescale.
void PoseFits::fitAll(const std::vector<SegmentPose>& poses, double scaling, ChainState& found) {
  for (size_t m = 0; m < layout_.size(); ++m) {
    SegmentState& segment = found.segments[m];
    PoseGrid grid = finePoses(models_[m], poses[m]);
    if (grid.scales == 1) grid.scale_step *= scaling;
    segment.image_from_segment =
        fitSegment(layout_[m], grid, {found, segment}, length_rates_[m], workspace_);
  }
}

/// Of all links, of how much they may; negative if one shrinks.
double PoseFits::leastGrowth(const std::vector<SegmentPose>& poses, const ChainState& found) const {
  double least = 1.0;
  for (size_t m = 0; m < layout_.size(); ++m) {
    const double growth = std::log(found.segments[m].image_from_segment.scale / poses[m].scale);
    least = std::min(least, growth / (0.5 * models_[m].scale_step));
  }
  return least;
}

}  // namespace chain_tracker
