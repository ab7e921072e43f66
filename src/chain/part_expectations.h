// SPDX-License-Identifier: BSD-3-Clause
/// What the parts of an object can be expected to show: how much they can tell at all, and how sure
/// they were lately.
#pragma once

#include <cstddef>
#include <vector>

#include "chain_tracker/chain/chain_state.h"
#include "chain_tracker/chain/object_appearance.h"

namespace chain_tracker {

class PartExpectations {
 public:
  /// Of `parts` parts.
  PartExpectations(ObjectAppearance& appearance, const AppearanceModel& model, size_t parts);

  /// Confidence of a part whose window costs `cost` by colours and texture, in [0, 1]: 0 where it
  /// costs what a flat piece of background would, and where the first frame did not show the part.
  double confidence(size_t part, double cost) const;

  /// Cost by colours from which on a part's window is taken for that of something else: its
  /// confidence would then be `share` of what it usually is.
  double colorOutlierCost(size_t part, double share) const;

  /// The same by colours and edges.
  double outlierCost(size_t part, double share) const;

  /// How much parts look as learned whose windows cost `costs` by all channels, in [0, 1]; `shares`
  /// of PartOverlaps. Busy backgrounds have edges, too: it tells which of two chains is the object,
  /// but not whether either is, as confidences do.
  double likeness(const std::vector<double>& costs, const std::vector<double>& shares) const;

  /// What `likeness` would be if all of the object were inside the image: what is outside looks
  /// about as the rest does, if that looks as usual, and the less so the less it does. `outside`:
  /// shares of the parts' windows, in [0, 1].
  double expectedLikeness(double likeness, const std::vector<double>& shares,
                          const std::vector<double>& outside) const;

  /// Mean confidence of `count` parts, weighted by what they can tell.
  double meanConfidence(const std::vector<PartState>& parts, size_t first, size_t count) const;

  /// Whether the first frame showed any of `count` parts.
  bool areKnown(size_t first, size_t count) const;

  /// Share of what the parts can tell that is told by hidden ones, in [0, 1].
  double hiddenShare(const std::vector<PartState>& parts) const;

  /// Of the object while it was believed in, weighted as meanConfidence(); 1 before anything was
  /// observed. Sinks within some twenty frames.
  double usualConfidence() const;

  /// Of the object while it was believed in, slow to sink; 1 before anything was observed.
  double usualLikeness() const { return usual_likeness_; }

  /// Takes in what a frame in which the object was found has shown.
  void observe(const std::vector<PartState>& parts, double likeness);

 private:
  std::vector<bool> is_known_;         ///< of each part: whether the first frame showed it
  std::vector<double> evidence_;       ///< of each part: what it would cost on a flat background
  std::vector<double> edge_evidence_;  ///< the same by edges, which the other leaves out
  std::vector<double> usual_;          ///< confidence of each part
  double usual_likeness_ = 1.0;
  bool has_observed_ = false;
};

}  // namespace chain_tracker
