// SPDX-License-Identifier: BSD-3-Clause
#include "line_ends.h"

#include <algorithm>
#include <cmath>

#include "chain_tracker/image/pixel_geometry.h"
#include "line_motion.h"

namespace chain_tracker {
namespace {

/// Distances between parts by which a line is tried longer, or shorter. What hides an end looks
/// like a line that becomes shorter, so that goes slowly.
constexpr double kLonger = 2.0;
constexpr double kShorter = 1.0;
/// Of the line, at most: the edges of one with few parts are long.
constexpr double kMostChange = 0.2;
/// Of the line, that has to be seen.
constexpr double kLeastSeen = 0.25;
/// Of the length in what speaks for a line. With all of it, a part more that is seen and one that
/// is not would be worth the same.
constexpr double kLengthPower = 0.7;

}  // namespace

LineEnds::LineEnds(const SegmentLayout& line)
    : first_length_(chainLengthOf(line)), part_(1.0 / static_cast<double>(line.edges.size())) {
  for (const EdgeLayout& edge : line.edges) first_lengths_.push_back(edge.length);
}

bool LineEnds::stretch(ChainState& line) {
  const double seen = seenShare(line);
  if (seen < kLeastSeen || !isShort(seen)) return false;
  stretches_last_ = !stretches_last_;
  layAlongSeen(stretches_last_, line);
  return true;
}

bool LineEnds::rescale(ChainState& line) {
  turn_ = (turn_ + 1) % 4;
  const bool grows = turn_ < 2;
  const double seen = seenShare(line);
  if (seen < kLeastSeen || (grows && isShort(seen))) return false;
  const double change = grows ? kLonger * part_ : -kShorter * part_;
  line.segments.front().image_from_segment.scale *=
      1.0 + std::clamp(change, -kMostChange, kMostChange);
  layAlongSeen(turn_ % 2 == 0, line);
  return true;
}

double LineEnds::score(const ChainState& line, double likeness) {
  takeSeenStretch(line, stretch_);
  return likeness * std::pow(lengthOf(stretch_) / first_length_, kLengthPower);
}

double LineEnds::seenShare(const ChainState& line) {
  takeSeenStretch(line, stretch_);
  return lengthOf(stretch_) / (line.segments.front().image_from_segment.scale * first_length_);
}

bool LineEnds::isShort(double seen) const { return seen <= 1.0 - part_; }

/// Along `stretch_`.
void LineEnds::layAlongSeen(bool moves_last, ChainState& line) {
  lengths_ = first_lengths_;
  for (double& length : lengths_) length *= line.segments.front().image_from_segment.scale;
  if (!moves_last) std::reverse(stretch_.begin(), stretch_.end());
  layAlong(stretch_, 0.0, lengths_, !moves_last, line);
}

}  // namespace chain_tracker
