// SPDX-License-Identifier: BSD-3-Clause
#include "line_alignment.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "chain_tracker/image/pixel_geometry.h"
#include "line_motion.h"

namespace chain_tracker {
namespace {

constexpr double kCellsPerWindow = 4.0;
/// Cells along the map, at most: bounds the time.
constexpr double kMostCells = 200.0;
constexpr double kSamplesPerPart = 2.0;
/// A line becomes that much longer or shorter at most, in steps of kScaleStep (both on a log
/// scale): what hides most of it hides that it comes nearer.
constexpr double kMostGrowth = 0.52;
constexpr double kScaleStep = 0.02;
/// Of the line, that has to be seen.
constexpr double kLeastSeen = 0.25;
/// Of the line, by which its middle may lie beyond what is seen of it, and by which the map goes on
/// there.
constexpr double kBeyond = 0.25;
constexpr double kMapBeyond = 0.5;
/// Calls after which all begins anew: in half of them a line may not become shorter. What goes on
/// beyond the stretch that is seen bends, so that a longer line costs more until it has bent, too.
/// Two calls each, as looks elsewhere and those along the line take turns.
constexpr int kTurns = 4;
/// Samples by which a part that is seen has to be moved: less the search around them does anyway.
constexpr double kLeastMove = 2.0;

/// The farthest that a part which is seen in `line` is from where `other` has it [px].
double farthestSeen(const ChainState& line, const ChainState& other) {
  double farthest = 0.0;
  for (size_t k = 0; k < line.parts.size(); ++k) {
    if (!line.parts[k].visible) continue;
    farthest = std::max(farthest, cv::norm(line.parts[k].position - other.parts[k].position));
  }
  return farthest;
}

cv::Point2d nearestIn(const cv::Rect2d& image, const cv::Point2d& point) {
  return {std::clamp(point.x, image.x, image.br().x), std::clamp(point.y, image.y, image.br().y)};
}

}  // namespace

LineAlignment::LineAlignment(const SegmentLayout& line, const AppearanceModel& model,
                             const cv::Size& image_size)
    : model_(model), image_(cv::Point(), image_size) {
  for (const EdgeLayout& edge : line.edges) first_lengths_.push_back(edge.length);
}

bool LineAlignment::align(const std::vector<Voter>& voters, double side, bool is_uniform,
                          FramePixels& pixels, ChainState& line) {
  measure(line);
  if (seen_ < kLeastSeen * length_) return false;
  sampleCosts(voters, side, pixels);
  const Fit fit = bestFit(is_uniform);
  const bool is_reversed = fit.placement.turn > 0;
  for (double& length : lengths_) length *= fit.scale;
  const double start = placeOf(fit.placement.middle.x) - 0.5 * fit.scale * length_;
  laid_ = line;
  layAlong(stretch_, start, lengths_, is_reversed, laid_);
  if (farthestSeen(line, laid_) < kLeastMove * spacing_) return false;
  Similarity& pose = laid_.segments.front().image_from_segment;
  pose.scale *= fit.scale;
  if (is_reversed) pose.angle = wrapAngle(pose.angle + CV_PI);
  std::swap(line, laid_);
  return true;
}

void LineAlignment::measure(const ChainState& line) {
  lengths_ = first_lengths_;
  for (double& length : lengths_) length *= line.segments.front().image_from_segment.scale;
  length_ = std::accumulate(lengths_.begin(), lengths_.end(), 0.0);
  places_.assign(1, -0.5 * length_);
  for (const double length : lengths_) places_.push_back(places_.back() + length);
  takeSeenStretch(line, stretch_);
  seen_ = lengthOf(stretch_);
  spacing_ = length_ / (kSamplesPerPart * static_cast<double>(lengths_.size()));
  margin_ = length_ * (kBeyond + 0.5 * std::exp(kMostGrowth)) + spacing_;
}

CellMap LineAlignment::cellsAlong(double side) const {
  const double beyond = kMapBeyond * length_;
  std::vector<cv::Point2d> way = stretch_;
  for (const double place : {-beyond, seen_ + beyond}) way.push_back(pointAlong(stretch_, place));
  // Not by an intersection, which is nothing where the way is level or upright.
  const cv::Rect2d around = uprightBounds(way);
  const cv::Rect2d bounds(nearestIn(image_, around.tl()), nearestIn(image_, around.br()));
  const double span = std::max(bounds.width, bounds.height);
  CellMap cells;
  cells.first = bounds.tl();
  cells.step = std::max(1, cvRound(std::max(side / kCellsPerWindow, span / kMostCells)));
  cells.size = {cvFloor(bounds.width / cells.step) + 1, cvFloor(bounds.height / cells.step) + 1};
  return cells;
}

void LineAlignment::sampleCosts(const std::vector<Voter>& voters, double side,
                                FramePixels& pixels) {
  const CellMap cells = cellsAlong(side);
  const std::vector<cv::Mat1f> maps = voterCosts(voters, side, cells, model_, pixels, workspace_);
  const int samples = cvCeil((seen_ + 2.0 * margin_) / spacing_) + 1;
  costs_.resize(voters.size());
  for (cv::Mat1f& row : costs_) row.create(1, samples);
  for (int i = 0; i < samples; ++i) {
    const cv::Point2d position = pointAlong(stretch_, placeOf(i));
    for (size_t k = 0; k < voters.size(); ++k) {
      costs_[k](i) = static_cast<float>(costAt(position, k, voters, cells, maps));
    }
  }
}

/// Turn 1 of 2 is the line the other way round.
Placement LineAlignment::cheapestAt(double scale, int directions) {
  offsets_.clear();
  for (const double place : places_) offsets_.emplace_back(scale * place / spacing_, 0.0);
  const double beyond = kBeyond * length_;
  const int first = cvCeil((margin_ - beyond) / spacing_);
  const int last = cvFloor((margin_ + seen_ + beyond) / spacing_);
  return cheapestPlacement(costs_, offsets_, {first, 0, last - first + 1, 1}, directions);
}

LineAlignment::Fit LineAlignment::bestFit(bool is_uniform) {
  const int steps = is_uniform ? 0 : cvRound(kMostGrowth / kScaleStep);
  turn_ = (turn_ + 1) % kTurns;
  Fit best;
  for (int i = turn_ < kTurns / 2 ? 0 : -steps; i <= steps; ++i) {
    const double scale = std::exp(i * kScaleStep);
    const Placement placement = cheapestAt(scale, is_uniform ? 1 : 2);
    if (placement.cost < best.placement.cost) best = {scale, placement};
  }
  return best;
}

}  // namespace chain_tracker
