// SPDX-License-Identifier: BSD-3-Clause
/// The best chain in one image, around where it is sought (thesis ch. 3.4): coarse candidates of
/// every part, all poses matched at once, then the same around the winner at full resolution.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/chain_matcher.h"
#include "chain_tracker/chain/chain_model.h"
#include "chain_tracker/chain/chain_refinement.h"
#include "chain_tracker/chain/chain_solver.h"
#include "chain_tracker/chain/chain_state.h"
#include "chain_tracker/chain/object_appearance.h"
#include "chain_tracker/chain/part_costs.h"
#include "chain_tracker/chain/pose_grid.h"
#include "chain_tracker/chain/segment_candidates.h"
#include "chain_tracker/chain/texture_costs.h"
#include "light_change.h"
#include "part_expectations.h"
#include "part_overlaps.h"
#include "placement_search.h"

namespace chain_tracker {

struct SearchRange {
  double radius = 0.0;         ///< of a part around where it is sought [px]
  double travel_weight = 0.0;  ///< cost of a part for every pixel from there
  double looseness = 1.0;      ///< of what bends anywhere: so much more than between two frames
};

/// What a search has found.
struct FoundChain {
  ChainState state;
  double likeness = 0.0;  ///< of PartExpectations; 0 if the springs allow no chain
};

class ChainSearch {
 public:
  /// `initial`: the object in the first frame, `image_from_segment` and parts only.
  ChainSearch(const ChainModel& model, const cv::Mat& image, const ChainLayout& layout,
              const ChainState& initial);
  ChainSearch(const ChainSearch&) = delete;
  ChainSearch& operator=(const ChainSearch&) = delete;

  const PartExpectations& expectations() const { return expectations_; }
  /// To be called with every chain that was taken for the object.
  void observe(const FoundChain& found);

  /// The image in which find() looks from now on; it must live as long.
  void show(const cv::Mat& image) { pixels_.show(image, light_.gains()); }

  /// `sought` moved to the best chain: parts, poses, confidence, energy and times; its status,
  /// outline and points are those of `sought`. Confidence 0 if the springs allow no chain.
  /// Time as of ChainTracker::update().
  FoundChain find(const ChainState& sought, const SearchRange& range);

  /// As find(), around the place of PlacementSearch within `reach` [px].
  FoundChain findAnywhere(const ChainState& sought, double reach, const SearchRange& range);

 private:
  /// Edges tell the object from what is around it even where its look has changed somewhat, texture
  /// tells to a fraction of a pixel where a window lies.
  enum class Stage { kCoarse, kFine };
  /// What is looked at: one entry a segment.
  struct Candidates {
    explicit Candidates(size_t count)
        : grids(count), segments(count), part_costs(count), edge_costs(count), poses(count) {}
    std::vector<CandidateGrid> grids;
    std::vector<SegmentCandidates> segments;
    std::vector<std::vector<cv::Mat1f>> part_costs;  ///< of all channels; the segments' have views
    std::vector<std::vector<cv::Mat1f>> edge_costs;  ///< of the parts, in the coarse stage
    std::vector<PoseGrid> poses;
    cv::Mat1f joint_costs;  ///< none
  };
  /// Of the parts of a segment, as it is turned.
  struct Looks {
    std::vector<RootHistogram> colors;
    std::vector<RootHistogram> edges;
    std::vector<WindowTexture> textures;
    std::vector<float> known;  ///< shares
  };
  /// Of the nodes of each segment.
  using NodePositions = std::vector<std::vector<cv::Point2d>>;

  size_t segments() const { return layout_.size(); }
  double sideOf(size_t m, double scale) const;
  double smallestSide(const std::vector<SegmentPose>& poses) const;
  cv::Point2d jointPosition(const ChainState& state, size_t m) const;
  std::vector<cv::Point2d> nodePositions(const ChainState& state, size_t m) const;
  std::vector<bool> nodesHidden(const ChainState& state, size_t m) const;
  void relaxSprings(const ChainState& state);

  void lookCoarsely();
  void lookFinely(const ChainMatch& coarse_match);
  void lookAround(const NodePositions& centers, const std::vector<SegmentPose>& poses, int step,
                  double radius, Stage stage, Candidates& candidates);
  const Looks& looksOf(size_t m, double turn);
  void computeCosts(size_t m, double turn, Stage stage, Candidates& candidates);
  void addEdgeCosts(size_t m, const Looks& looks, Candidates& candidates);
  void joinCosts(size_t m, Candidates& candidates) const;
  void keepEdgeCosts(const ChainMatch& coarse_match);
  void robustify(Candidates& candidates) const;
  double turnOf(const ChainState& state, size_t part) const;
  std::vector<Similarity> placements(const ChainState& sought, double reach);
  std::vector<Voter> votersOf(const ChainState& state, size_t m);
  ChainMatch matched(const std::vector<PoseGrid>& poses,
                     const std::vector<SegmentCandidates>& candidates,
                     ChainMatcherWorkspace& workspace) const;
  ChainMatch matchFinePoses();
  void settle(std::vector<SegmentPose> poses, FoundChain& found);
  double likeness(const std::vector<RefinedPart>& refined,
                  const std::vector<PartState>& parts) const;
  void observeLight(const ChainState& state);
  void fillIn(const std::vector<RefinedPart>& parts, const std::vector<SegmentPose>& poses,
              ChainState& found) const;

  ChainModel model_;
  std::vector<SegmentLayout> layout_;
  ObjectAppearance appearance_;
  PartExpectations expectations_;
  PartOverlaps overlaps_;
  LightChange light_;
  PlacementSearch placement_search_;
  std::vector<double> initial_orientations_;           // of the parts
  std::vector<std::vector<double>> remembered_turns_;  // of each segment's edges
  std::vector<double> variance_shares_;  // of the parts, in what the chain alone would leave
  // Of the search that goes on.
  ChainState sought_;
  std::vector<SegmentPose> previous_;
  SearchRange range_;
  Candidates coarse_;
  Candidates fine_;
  std::vector<SegmentCandidates> middles_;  // of the fine ones, enough to tell poses apart
  std::vector<double> edge_costs_;          // of the parts where the coarse search found them

  FramePixels pixels_;
  std::vector<ObjectColor> learned_colors_;  // of the parts that are seen
  std::vector<ObjectColor> seen_colors_;
  PartCostsWorkspace color_workspace_;
  PartCostsWorkspace edge_workspace_;
  TextureCostsWorkspace texture_workspace_;
  std::vector<Looks> looks_;  // of the segments
  // One for each number of states, which would else be allocated anew.
  ChainMatcherWorkspace coarse_workspace_;
  ChainMatcherWorkspace pose_workspace_;
  ChainRefinementWorkspace fine_workspace_;
};

}  // namespace chain_tracker
