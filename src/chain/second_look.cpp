// SPDX-License-Identifier: BSD-3-Clause
#include "second_look.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "line_motion.h"
#include "state_motion.h"

namespace chain_tracker {
namespace {

/// Reach of the widest search, fraction of the image diagonal: for an object in doubt, and for one
/// that is lost and may come back anywhere.
constexpr double kWidestInDoubt = 0.5;
constexpr double kWidestWhenLost = 1.0;
/// A doubtful object is looked for elsewhere, and a hidden segment at other angles, in every so
/// many frames.
constexpr int kFramesPerLook = 2;
/// How much more likeness it takes to believe that it is there, or that a line is.
constexpr double kClearlyBetter = 0.1;
constexpr double kBetterLine = 0.05;
/// The same where all segments hang otherwise; where some do, their share of it, up to
/// kClearlyBetter.
constexpr double kBetterSegment = 0.3;
/// So far, of its extent, from where an object in doubt is taken to be lies another place, which
/// has to look like the object by so much of the usual likeness. An object that looks less and less
/// like itself is still where it is rather than where something looks a little more like it.
constexpr double kElsewhere = 0.7;
constexpr double kKnown = 0.6;
/// Of an object in doubt, to each side, at least [rad].
constexpr double kLeastTurn = 0.4;
/// Of the usual likeness: a state that is trusted to be right, by which it is looked for later.
constexpr double kTrusted = 0.8;
/// The same of a line, which is in doubt until then: found again shifted along itself it looks much
/// like the object, but does not slide back by itself.
constexpr double kTrustedLine = 0.95;
/// A line that is found again may have bent by so much more than between two frames, and that in up
/// to so many steps, as long as each makes it look more as learned by kLeastGain. After the first
/// its parts move little: of the usual reach, and so many candidates.
constexpr double kLoose = 3.0;
constexpr int kRefits = 4;
constexpr double kLeastGain = 0.01;
constexpr double kRefitReach = 0.5;
/// Of the expected likeness of what is doubted: no line that its first step left below has become
/// better.
constexpr double kHopeless = 0.75;
constexpr double kRefitCandidates = 32.0;
/// Around a line whose ends were moved: of the usual reach, of what it may bend between two frames,
/// and how much more has to speak for it.
constexpr double kEndReach = 0.15;
constexpr double kLooseEnds = 2.0;
constexpr double kBetterEnds = 0.004;
/// By so much of its length a line is shifted along itself to see whether it goes on there: then it
/// looks as it did, else it loses as much.
constexpr double kBeyond = 0.1;
/// Of a line, from end to end, of its length in the first frame: an open one.
constexpr double kOpen = 0.25;
/// Of the object's usual confidence: that of a segment which is where it was found.
constexpr double kSeen = 0.5;

/// The two ways round a contour that nearly closes are mirror images of one another, which no
/// motion exchanges.
bool isOpen(const SegmentLayout& line) {
  const cv::Point2d ends = line.parts.back().position - line.parts.front().position;
  return cv::norm(ends) > kOpen * chainLengthOf(line);
}

}  // namespace

SecondLook::SecondLook(const ChainModel& model, const ChainLayout& layout,
                       const cv::Size& image_size, const ChainState& initial, ChainSearch& search,
                       ObjectShape& shape)
    : model_(model),
      is_line_(layout.segments.size() == 1 &&
               layout.segments.front().layout == Layout::kDeformable),
      is_open_line_(is_line_ && isOpen(layout.segments.front())),
      is_uniform_line_(is_open_line_ && search.isUniform()),
      tries_ends_(is_open_line_ && !search.isClearlyMarked()),
      image_size_(image_size),
      search_(search),
      shape_(shape),
      trusted_(initial),
      ends_(layout.segments.front()) {}

void SecondLook::reconsider(const ChainState& before, FoundChain& found) {
  frame_ = (frame_ + 1) % kFramesPerLook;
  if (tries_ends_ && !isDoubtful(found)) tryEnds(found);
  if (isDoubtful(found)) {
    ++frames_doubted_;
    lookElsewhere(before, found);
  } else if (frame_ == 0) {
    tryOtherBends(found);
  }
  if (!isDoubtful(found)) frames_doubted_ = 0;
}

void SecondLook::lookElsewhere(const ChainState& before, FoundChain& found) {
  const double least = kHopeless * found.expected_likeness;
  if (frames_doubted_ == 1) {
    for (const int side : {-1, 1}) preferBetter(turned(side, before), found);
  } else if (frames_doubted_ % kFramesPerLook == 0) {
    preferLook(look(frames_doubted_ / kFramesPerLook, kWidestInDoubt, least), found);
  } else if (is_open_line_) {
    FoundChain aligned = found;
    if (align(aligned)) preferBetter(refitted(std::move(aligned), least), found);
  } else {
    tryOtherBends(found);
  }
}

FoundChain SecondLook::findLost(int frames_lost) {
  FoundChain found = look(frames_lost, kWidestWhenLost, 0.0);
  if (past_views_.showed(found.state, image_)) forget(found);
  return found;
}

void SecondLook::observe(const FoundChain& found) {
  const double least = is_line_ ? kTrustedLine : kTrusted;
  if (found.expected_likeness < least * search_.expectations().usualLikeness()) return;
  trusted_ = found.state;
  past_views_.remember(image_, found.state);
}

bool SecondLook::isDoubtful(const FoundChain& found) const {
  const double doubt_below = model_.search.doubt_below;
  const bool must_reassure = is_line_ && frames_doubted_ > 0;
  const double least = must_reassure ? std::max(doubt_below, kTrustedLine) : doubt_below;
  return found.likeness < least * search_.expectations().usualLikeness();
}

void SecondLook::preferBetter(FoundChain other, FoundChain& found) const {
  preferBetter(std::move(other), is_line_ ? kBetterLine : kClearlyBetter, found);
}

/// A chain elsewhere is believed in if it is better by `gain`, would do to end a loss and is
/// nothing that stood there before. What lies outside the image speaks for neither: a chain of
/// which less can be seen than of another one is not worse for that.
void SecondLook::preferBetter(FoundChain other, double gain, FoundChain& found) const {
  const bool is_sure = other.state.confidence >= model_.search.found_above;
  const bool is_better = other.expected_likeness > found.expected_likeness + gain;
  if (is_sure && is_better && !past_views_.showed(other.state, image_)) found = std::move(other);
}

void SecondLook::preferLook(FoundChain other, FoundChain& found) const {
  const double way = cv::norm(middleOf(other.state) - middleOf(found.state));
  const bool is_elsewhere = way > kElsewhere * extentOf(trusted_);
  const double known = kKnown * search_.expectations().usualLikeness();
  if (!is_elsewhere || other.expected_likeness >= known) preferBetter(std::move(other), found);
}

/// Of a search that has failed so often [px]: twice as far every time, up to `widest`.
double SecondLook::reach(int failures, double widest) const {
  const double diagonal = std::hypot(image_size_.width, image_size_.height);
  const double farther = std::ldexp(model_.search.radius, std::min(failures, 16));
  return diagonal * std::min(farther, std::max(model_.search.radius, widest));
}

FoundChain SecondLook::find(const ChainState& sought, const SearchRange& range) {
  FoundChain found;
  search_.find(sought, range, found);
  return found;
}

/// Around where the object was last seen for sure: a chain as it was then or, every other time,
/// one around wherever its segments fit best; rough if it stays below the `least` expected
/// likeness.
FoundChain SecondLook::look(int failures, double widest, double least) {
  const double farthest = reach(failures, widest);
  FoundChain found;
  if (failures % 2 == 0) {
    search_.findAnywhere(trusted_, farthest, {searchRadius(), 0.0}, found);
  } else {
    found = find(trusted_, {farthest, 0.0});
  }
  const bool is_believed = found.state.confidence >= model_.search.found_above;
  if (is_line_) {
    if (is_open_line_ && is_believed) align(found);
    found = refitted(std::move(found), least);
    if (is_uniform_line_ && liesReversed(found.state, trusted_)) reverse(found.state);
  }
  if (!is_open_line_ && is_believed) preferBetter(halfTurned(found), found);
  return found;
}

/// Just beyond what the hypotheses cover, to one side.
FoundChain SecondLook::turned(int side, const ChainState& before) {
  const SegmentModel& model = model_.segments.front();
  const double covered = model.orientation_hypotheses * model.orientation_step;
  ChainState sought = before;
  turnWhole(side * std::clamp(covered, kLeastTurn, CV_PI), sought);
  return find(sought, {reach(1, kWidestInDoubt), 0.0});
}

/// What is found of an object whose two ends look alike may be the wrong way round.
FoundChain SecondLook::halfTurned(const FoundChain& found) {
  ChainState sought = found.state;
  turnWhole(CV_PI, sought);
  return find(sought, {searchRadius(), 0.0});
}

/// A line bent along what it was found on, then as stiff as ever: one that may bend at will fits
/// anything. Springs that remember where each edge pointed keep it from sliding along itself. Given
/// up, as it is by then, once below the `least` expected likeness.
FoundChain SecondLook::refitted(FoundChain found, double least) {
  const double near = kRefitReach * searchRadius();
  SearchRange range{searchRadius(), 0.0, kLoose};
  for (int i = 0; i < kRefits; ++i) {
    shape_.carry(found.state);
    FoundChain bent = find(found.state, range);
    if (bent.likeness < found.likeness + kLeastGain) break;
    found = std::move(bent);
    range = {near, 0.0, kLoose, kRefitCandidates};
    if (found.expected_likeness < least) return found;
  }
  shape_.carry(found.state);
  return find(found.state, {near, 0.0, 1.0, kRefitCandidates});
}

/// Nothing but its ends may tell how long a line is, and how far it lies along itself.
void SecondLook::tryEnds(FoundChain& found) {
  if (!knows_ends_) learnEnds(found);
  sought_ = found.state;
  if (ends_.stretch(sought_)) preferOtherEnds(found);
  sought_ = found.state;
  if (tells_length_ && ends_.rescale(sought_)) preferOtherEnds(found);
}

/// What goes on beyond an end in the first frames is not all of a line: nothing tells its length.
void SecondLook::learnEnds(const FoundChain& found) {
  knows_ends_ = true;
  const double parts = static_cast<double>(found.state.parts.size());
  const int places = std::max(1, static_cast<int>(kBeyond * parts));
  for (const int way : {-places, places}) {
    sought_ = found.state;
    slide(way, sought_);
    seekEnds();
    tells_length_ =
        tells_length_ && other_.likeness < found.likeness * (1.0 - 0.5 * places / parts);
  }
}

/// Around `sought_`.
void SecondLook::seekEnds() {
  shape_.carry(sought_);
  SearchRange range{kEndReach * searchRadius(), 0.0, kLooseEnds};
  range.is_narrow = true;
  search_.find(sought_, range, other_);
}

/// What is found around `sought_`, if more speaks for it.
void SecondLook::preferOtherEnds(FoundChain& found) {
  seekEnds();
  const bool is_sure = other_.state.confidence >= model_.search.found_above;
  const double gain =
      ends_.score(other_.state, other_.likeness) - ends_.score(found.state, found.likeness);
  if (is_sure && gain > kBetterEnds) std::swap(found, other_);
}

/// Moves a line along itself to where its parts look more as learned; false if nowhere.
bool SecondLook::align(FoundChain& found) {
  sought_ = found.state;
  if (!search_.alignLine(sought_)) return false;
  shape_.carry(sought_);
  FoundChain aligned = find(sought_, {searchRadius(), 0.0, kLoose});
  if (aligned.likeness <= found.likeness) return false;
  found = std::move(aligned);
  return true;
}

/// Segments that turned while they were hidden hang at angles that no hypothesis reaches; a few of
/// many leave the object itself beyond doubt.
void SecondLook::tryOtherBends(FoundChain& found) {
  takeHeldSegments(found.state);
  const auto loose = std::count(is_held_.begin(), is_held_.end(), false);
  const auto all = static_cast<std::ptrdiff_t>(is_held_.size());
  if (loose == 0 || loose == all) return;
  FoundChain hung;
  search_.findHung(found.state, is_held_, {searchRadius(), 0.0}, hung);
  const double share = static_cast<double>(loose) / static_cast<double>(all);
  preferBetter(std::move(hung), std::min(kClearlyBetter, kBetterSegment * share), found);
}

/// Those that are seen, and those between them, which are held by both; nothing tells where else
/// those may be that the first frame did not show.
void SecondLook::takeHeldSegments(const ChainState& found) {
  const PartExpectations& expectations = search_.expectations();
  const double least = kSeen * expectations.usualConfidence();
  is_held_.clear();
  for (const SegmentState& segment : found.segments) {
    const bool is_known = expectations.areKnown(static_cast<size_t>(segment.first_part),
                                                static_cast<size_t>(segment.part_count));
    is_held_.push_back(!is_known || segment.confidence >= least);
  }
  const auto first = std::find(is_held_.begin(), is_held_.end(), true);
  if (first == is_held_.end()) return;
  std::fill(first, std::find(is_held_.rbegin(), is_held_.rend(), true).base(), true);
}

}  // namespace chain_tracker
