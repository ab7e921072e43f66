// SPDX-License-Identifier: BSD-3-Clause
/// The best chain in one image, around where it is sought (thesis ch. 3.4): coarse candidates of
/// every part, all poses matched at once, then the same around the winner at full resolution.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "appearance_costs.h"
#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/chain_matcher.h"
#include "chain_tracker/chain/chain_model.h"
#include "chain_tracker/chain/chain_refinement.h"
#include "chain_tracker/chain/chain_solver.h"
#include "chain_tracker/chain/chain_state.h"
#include "chain_tracker/chain/part_costs.h"
#include "chain_tracker/chain/pose_grid.h"
#include "chain_tracker/chain/segment_candidates.h"
#include "joint_memory.h"
#include "line_alignment.h"
#include "part_expectations.h"
#include "part_overlaps.h"
#include "placement_search.h"
#include "pose_fits.h"
#include "spring_relaxation.h"

namespace chain_tracker {

struct SearchRange {
  double radius = 0.0;         ///< of a part around where it is sought [px]
  double travel_weight = 0.0;  ///< cost of a part for every pixel from there
  double looseness = 1.0;      ///< of what bends anywhere: so much more than between two frames
  /// Candidates along a side of the search window up to which the lattice stays fine.
  double most_candidates = 64.0;
  bool is_narrow = false;  ///< far narrower than most: with maps of its own, which stay as large
};

/// What a search has found.
struct FoundChain {
  ChainState state;
  // Of PartExpectations; 0 if the springs allow no chain.
  double likeness = 0.0;
  double expected_likeness = 0.0;
};

/// Leaves it where it was found, but believes nothing of it.
void forget(FoundChain& found);

class ChainSearch {
 public:
  /// `initial`: the object in the first frame, `image_from_segment` and parts only.
  ChainSearch(const ChainModel& model, const cv::Mat& image, const ChainLayout& layout,
              const ChainState& initial);
  ChainSearch(const ChainSearch&) = delete;
  ChainSearch& operator=(const ChainSearch&) = delete;

  /// That share the work from now on, at least 1: nothing but the time depends on it.
  void useThreads(int threads);

  const PartExpectations& expectations() const { return expectations_; }
  /// Whether the parts of a line, the only segment, tell little of where on it they are.
  bool isUniform() const;
  /// Whether they tell it beyond doubt.
  bool isClearlyMarked() const { return is_clearly_marked_; }
  /// To be called with every chain that was taken for the object.
  void observe(const FoundChain& found);

  /// The image in which find() looks from now on; it must live as long.
  void show(const cv::Mat& image, SearchLight light) { appearance_.show(image, light); }

  /// `found` becomes `sought` moved to the best chain: parts, poses and confidence;
  /// its status, outline and points are those of `sought`. Confidence 0 if the springs allow no
  /// chain or if nine tenths of it lie outside the image. Time as of ChainTracker::update().
  void find(const ChainState& sought, const SearchRange& range, FoundChain& found);

  /// As find(), around the place of PlacementSearch within `reach` [px].
  void findAnywhere(const ChainState& sought, double reach, const SearchRange& range,
                    FoundChain& found);

  /// As find(), with the segments that are not `seen`, some of them, hanging from the others at
  /// whatever angles they fit best.
  void findHung(const ChainState& sought, const std::vector<bool>& seen, const SearchRange& range,
                FoundChain& found);

  /// Lays a line, the only segment, as LineAlignment says: false if that leaves it as it is.
  bool alignLine(ChainState& line);

 private:
  /// The object as links, of which some parts are asked.
  struct Linkage {
    std::vector<RigidSegment> segments;
    std::vector<Hinge> hinges;
  };

  /// What is looked at: one entry a segment.
  struct Candidates {
    explicit Candidates(size_t count) : grids(count), segments(count), costs(count), poses(count) {}
    std::vector<CandidateGrid> grids;
    std::vector<SegmentCandidates> segments;
    std::vector<SegmentCosts> costs;  ///< of the parts; the segments have views of them
    std::vector<PoseGrid> poses;
    cv::Mat1f joint_costs;  ///< none
  };

  /// The first look around, and what it keeps from call to call.
  struct CoarseSearch {
    explicit CoarseSearch(size_t count) : candidates(count) {}
    Candidates candidates;
    ChainMatcherWorkspace workspace;
  };

  size_t segments() const { return layout_.size(); }
  std::vector<RootHistogram> colorsOf(const SegmentState& initial);
  std::vector<double> lengthRates(const ChainState& initial);
  double sideOf(size_t m, double scale) const;
  double smallestSide(const std::vector<SegmentPose>& poses) const;

  void lookCoarsely();
  void lookFinely(const ChainMatch& coarse_match);
  void lookAround(const std::vector<SegmentPose>& poses, int step, double radius, SearchStage stage,
                  Candidates& candidates);
  void joinCosts(size_t m, Candidates& candidates) const;
  void keepEdgeCosts(const ChainMatch& coarse_match);
  void robustify(Candidates& candidates) const;
  Linkage linkageOf(const ChainState& state);
  void findMoved(const ChainState& sought, const std::vector<Similarity>& motions,
                 const SearchRange& range, FoundChain& found);
  std::vector<Voter> votersOf(const ChainState& state, size_t m, size_t wanted);
  const ChainMatch& matched(const std::vector<PoseGrid>& poses,
                            const std::vector<SegmentCandidates>& candidates,
                            ChainMatcherWorkspace& workspace) const;
  const ChainMatch& matchFinePoses();
  void settle(FoundChain& found);
  void compare(const std::vector<RefinedPart>& refined, FoundChain& found);
  void fillIn(const std::vector<RefinedPart>& parts, ChainState& found);

  ChainModel model_;
  std::vector<SegmentLayout> layout_;
  AppearanceCosts appearance_;
  cv::Rect2d image_;  // its pixels with their borders
  PartExpectations expectations_;
  PartOverlaps overlaps_;
  JointMemory joint_memory_;
  SpringRelaxation springs_;
  PlacementSearch placement_search_;
  PoseFits pose_fits_;
  LineAlignment line_alignment_;  // of the first segment
  bool is_clearly_marked_ = false;
  int threads_ = 1;
  std::vector<double> variance_shares_;  // of the parts, in what the chain alone would leave
  // Of the search that goes on.
  ChainState sought_;
  std::vector<SegmentPose> previous_;
  SearchRange range_;
  CoarseSearch wide_;
  CoarseSearch narrow_;
  CoarseSearch* coarse_ = &wide_;
  Candidates fine_;
  std::vector<SegmentCandidates> middles_;         // of the fine ones, enough to tell poses apart
  std::vector<std::vector<cv::Point2d>> centers_;  // of each segment's nodes, around which to look
  std::vector<cv::Point2d> part_centers_;
  std::vector<SegmentPose> poses_;
  std::vector<double> edge_costs_;  // of the parts where the coarse search found them
  std::vector<double> costs_;       // of the parts by all channels
  std::vector<double> shares_;      // of PartOverlaps
  std::vector<double> outside_;     // shares of the parts' windows
  // One for each number of states, which would else be allocated anew.
  ChainMatcherWorkspace pose_workspace_;
  ChainRefinementWorkspace fine_workspace_;
};

}  // namespace chain_tracker
