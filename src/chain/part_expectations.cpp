// SPDX-License-Identifier: BSD-3-Clause
#include "part_expectations.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace chain_tracker {
namespace {

/// Of a part whose window shows nothing of the object, of the largest cost.
constexpr double kLeastEvidence = 0.1;
/// Of a part of which the first frame shows nothing [cost]: more than none, which divides.
constexpr double kNoEvidence = 1e-3;
/// Share of the new in what is usual, per frame. A part comes to look different within some ten
/// frames; an object in doubt for a hundred is still in doubt.
constexpr double kRise = 0.1;
constexpr double kPartSinks = 0.05;
constexpr double kObjectSinks = 0.003;

/// Of the likeness of the rest, what is outside the image is believed to have: less than all, so
/// that of two chains that look alike the one is preferred of which more is seen.
constexpr double kBelievedOutside = 0.9;

/// What a part would cost on a flat piece of background: little if its own window shows little
/// else, so that it cannot tell whether the object is there.
double evidenceOf(const PartAppearance& learned, const AppearanceModel& model) {
  const double other = learned.colors[ColorPalette::kOther];
  const double colors = std::sqrt(std::max(0.0, 1.0 - other));
  const double texture = 0.5 * strengthOf(learned.texture);
  const double least = kLeastEvidence * (model.weight + model.haar_weight);
  const double told = std::max(least, model.weight * colors + model.haar_weight * texture);
  return std::max(kNoEvidence, learned.known * told);
}

double edgeEvidenceOf(const PartAppearance& learned, const AppearanceModel& model) {
  const double edges = std::sqrt(std::max(0.0, 1.0 - double(learned.edges[kNoEdge])));
  return learned.known * model.edge_weight * edges;
}

double followed(double usual, double now, double sinks) {
  return usual + (now > usual ? kRise : sinks) * (now - usual);
}

}  // namespace

PartExpectations::PartExpectations(ObjectAppearance& appearance, const AppearanceModel& model,
                                   size_t parts)
    : usual_(parts, 1.0) {
  for (size_t k = 0; k < parts; ++k) {
    const PartAppearance& learned = appearance.part(k, 0.0);
    is_known_.push_back(learned.known > 0.0F);
    evidence_.push_back(evidenceOf(learned, model));
    edge_evidence_.push_back(edgeEvidenceOf(learned, model));
  }
}

double PartExpectations::confidence(size_t part, double cost) const {
  return is_known_[part] ? std::clamp(1.0 - cost / evidence_[part], 0.0, 1.0) : 0.0;
}

double PartExpectations::colorOutlierCost(size_t part, double share) const {
  return evidence_[part] * (1.0 - share * usual_[part]);
}

double PartExpectations::outlierCost(size_t part, double share) const {
  return (evidence_[part] + edge_evidence_[part]) * (1.0 - share * usual_[part]);
}

double PartExpectations::likeness(const std::vector<double>& costs,
                                  const std::vector<double>& shares) const {
  double like = 0.0;
  double all = 0.0;
  for (size_t k = 0; k < costs.size(); ++k) {
    const double evidence = evidence_[k] + edge_evidence_[k];
    like += shares[k] * std::clamp(evidence - costs[k], 0.0, evidence);
    all += evidence;
  }
  return like / all;
}

double PartExpectations::expectedLikeness(double likeness, const std::vector<double>& shares,
                                          const std::vector<double>& outside) const {
  double all = 0.0;
  double unseen = 0.0;
  for (size_t k = 0; k < outside.size(); ++k) {
    const double evidence = evidence_[k] + edge_evidence_[k];
    unseen += shares[k] * outside[k] * evidence;
    all += evidence;
  }
  const double rest = std::min(1.0, likeness * all / std::max(kNoEvidence, all - unseen));
  const double believed = kBelievedOutside * std::min(1.0, rest / usual_likeness_);
  return likeness + believed * rest * unseen / all;
}

double PartExpectations::meanConfidence(const std::vector<PartState>& parts, size_t first,
                                        size_t count) const {
  double sum = 0.0;
  double weights = 0.0;
  for (size_t k = first; k < first + count; ++k) {
    sum += evidence_[k] * parts[k].confidence;
    weights += evidence_[k];
  }
  return sum / weights;
}

bool PartExpectations::areKnown(size_t first, size_t count) const {
  const auto begin = is_known_.begin() + static_cast<std::ptrdiff_t>(first);
  return std::find(begin, begin + static_cast<std::ptrdiff_t>(count), true) !=
         begin + static_cast<std::ptrdiff_t>(count);
}

double PartExpectations::usualConfidence() const {
  const double weights = std::accumulate(evidence_.begin(), evidence_.end(), 0.0);
  return std::inner_product(evidence_.begin(), evidence_.end(), usual_.begin(), 0.0) / weights;
}

double PartExpectations::hiddenShare(const std::vector<PartState>& parts) const {
  double hidden = 0.0;
  double all = 0.0;
  for (size_t k = 0; k < parts.size(); ++k) {
    if (!parts[k].visible) hidden += evidence_[k];
    all += evidence_[k];
  }
  return hidden / all;
}

void PartExpectations::observe(const std::vector<PartState>& parts, double likeness) {
  for (size_t k = 0; k < usual_.size(); ++k) {
    usual_[k] = followed(usual_[k], parts[k].confidence, kPartSinks);
  }
  usual_likeness_ = has_observed_ ? followed(usual_likeness_, likeness, kObjectSinks) : likeness;
  has_observed_ = true;
}

}  // namespace chain_tracker
