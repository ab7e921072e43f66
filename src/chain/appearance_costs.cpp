// SPDX-License-Identifier: BSD-3-Clause
#include "appearance_costs.h"

#include "chain_tracker/image/pixel_geometry.h"
#include "texture_weight.h"

namespace chain_tracker {
namespace {

/// A part that the first frame shows half of counts half.
void weigh(const std::vector<float>& shares, std::vector<cv::Mat1f>& costs) {
  for (size_t k = 0; k < costs.size(); ++k) {
    if (shares[k] < 1.0F) costs[k] *= shares[k];
  }
}

}  // namespace

AppearanceCosts::AppearanceCosts(const AppearanceModel& model, const cv::Mat& image,
                                 const ChainLayout& layout, const ChainState& initial)
    : learned_(image, layout, model),
      model_(withMeasuredTexture(model, layout, learned_)),
      jump_(image),
      light_(model.light_rate),
      pixels_(learned_.palette()),
      looks_(layout.segments.size()) {
  for (const PartState& part : initial.parts) initial_orientations_.push_back(part.orientation);
}

const PartAppearance& AppearanceCosts::lookOf(const ChainState& state, size_t part, double turn) {
  const double turned = wrapAngle(state.parts[part].orientation - initial_orientations_[part]);
  return learned_.part(part, wrapAngle(turned + turn));
}

void AppearanceCosts::show(const cv::Mat& image, SearchLight light) {
  shown_ = light;
  if (model_.light_rate > 0.0) light_.jump(jump_.observe(image));
  pixels_.show(image, light == SearchLight::kLatest ? light_.gains() : ChannelGains());
}

void AppearanceCosts::keepLight() {
  if (shown_ == SearchLight::kFirst) light_ = LightChange(model_.light_rate);
}

void AppearanceCosts::observeLight(const ChainState& state) {
  if (model_.light_rate == 0.0) return;
  learned_colors_.clear();
  seen_colors_.clear();
  for (size_t k = 0; k < state.parts.size(); ++k) {
    const PartState& part = state.parts[k];
    if (!part.visible) continue;
    learned_colors_.push_back(lookOf(state, k).middle);
    seen_colors_.push_back(pixels_.objectColor(middleOfWindow(part.position, part.side)));
  }
  light_.observe(learned_colors_, seen_colors_);
}

void AppearanceCosts::compute(const ChainState& sought, size_t m, double turn,
                              const CandidateGrid& grid, SearchStage stage, SegmentCosts& costs) {
  const Looks& looks = looksOf(sought, m, turn);
  computePartCosts(pixels_, Channel::kColors, looks.colors, grid, model_.weight, costs.parts,
                   color_workspace_);
  if (stage == SearchStage::kFine && model_.haar_weight > 0.0) {
    addTextureCosts(pixels_, looks.textures, grid, model_.haar_weight, costs.parts,
                    texture_workspace_);
  }
  weigh(looks.known, costs.parts);
  if (stage == SearchStage::kCoarse && model_.edge_weight > 0.0) {
    computePartCosts(pixels_, Channel::kEdges, looks.edges, grid, model_.edge_weight, costs.edges,
                     edge_workspace_);
    weigh(looks.known, costs.edges);
    for (size_t k = 0; k < costs.parts.size(); ++k) costs.parts[k] += costs.edges[k];
  }
}

const AppearanceCosts::Looks& AppearanceCosts::looksOf(const ChainState& sought, size_t m,
                                                       double turn) {
  const auto first = static_cast<size_t>(sought.segments[m].first_part);
  const auto parts = static_cast<size_t>(sought.segments[m].part_count);
  Looks& looks = looks_[m];
  looks.colors.resize(parts);
  looks.edges.resize(parts);
  looks.textures.resize(parts);
  looks.known.resize(parts);
  for (size_t k = 0; k < parts; ++k) {
    const PartAppearance& learned = lookOf(sought, first + k, turn);
    looks.colors[k] = learned.colors;
    looks.edges[k] = learned.edges;
    looks.textures[k] = learned.texture;
    looks.known[k] = learned.known;
  }
  return looks;
}

}  // namespace chain_tracker
