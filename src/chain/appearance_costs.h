// SPDX-License-Identifier: BSD-3-Clause
/// What it costs to have the parts of an object at their candidate positions, by how each looked in
/// the first frame: its colours, edges and texture, in the light of now (term A of thesis ch.
/// 3.2.1).
#pragma once

#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/chain_model.h"
#include "chain_tracker/chain/chain_state.h"
#include "chain_tracker/chain/object_appearance.h"
#include "chain_tracker/chain/part_costs.h"
#include "chain_tracker/chain/texture_costs.h"
#include "light_change.h"
#include "light_jump.h"

namespace chain_tracker {

/// Edges tell the object from what is around it even where its look has changed somewhat, texture
/// tells to a fraction of a pixel where a window lies.
enum class SearchStage { kCoarse, kFine };

/// The light that parts are looked for in: as they were last seen in it, or that of the first
/// frame.
enum class SearchLight { kLatest, kFirst };

/// Of the parts of a segment, one map of its candidates each.
struct SegmentCosts {
  std::vector<cv::Mat1f> parts;  ///< all that the stage looks at
  std::vector<cv::Mat1f> edges;  ///< their share in that, in the coarse stage; else as they were
};

class AppearanceCosts {
 public:
  /// `initial`: the object in `image`, the first frame.
  AppearanceCosts(const AppearanceModel& model, const cv::Mat& image, const ChainLayout& layout,
                  const ChainState& initial);
  AppearanceCosts(const AppearanceCosts&) = delete;
  AppearanceCosts& operator=(const AppearanceCosts&) = delete;

  /// That share the work, at least 1.
  void useThreads(int threads) { color_workspace_.threads = edge_workspace_.threads = threads; }

  /// With the weights that fit the object.
  const AppearanceModel& model() const { return model_; }
  ObjectAppearance& learned() { return learned_; }
  /// What a part looks like as it is turned in `state`, and then by `turn` [rad].
  const PartAppearance& lookOf(const ChainState& state, size_t part, double turn = 0.0);

  /// The image that is looked at from now on; it must live as long.
  void show(const cv::Mat& image, SearchLight light = SearchLight::kLatest);
  FramePixels& pixels() { return pixels_; }

  /// To be called where the object was found in the image: the light in which it was shows from now
  /// on.
  void keepLight();

  /// Takes in how the light on the object has changed, if it is where `state` has it.
  void observeLight(const ChainState& state);

  /// Costs of the candidates in `grid` of segment `m` turned by `turn` [rad] from how it is in
  /// `sought`. Time as of computePartCosts() and addTextureCosts().
  void compute(const ChainState& sought, size_t m, double turn, const CandidateGrid& grid,
               SearchStage stage, SegmentCosts& costs);

 private:
  /// Of the parts of a segment.
  struct Looks {
    std::vector<RootHistogram> colors;
    std::vector<RootHistogram> edges;
    std::vector<WindowTexture> textures;
    std::vector<float> known;  ///< shares
  };

  const Looks& looksOf(const ChainState& sought, size_t m, double turn);

  ObjectAppearance learned_;
  AppearanceModel model_;
  std::vector<double> initial_orientations_;  // of the parts
  LightJump jump_;
  LightChange light_;
  SearchLight shown_ = SearchLight::kLatest;
  FramePixels pixels_;
  std::vector<ObjectColor> learned_colors_;  // of the parts that are seen
  std::vector<ObjectColor> seen_colors_;
  std::vector<Looks> looks_;  // of the segments
  PartCostsWorkspace color_workspace_;
  PartCostsWorkspace edge_workspace_;
  TextureCostsWorkspace texture_workspace_;
};

}  // namespace chain_tracker
