// SPDX-License-Identifier: BSD-3-Clause
/// Where an object may be that is in doubt or lost: what the search around its last place has found
/// is held against what it may have been mistaken for, and against what is found elsewhere.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_search.h"
#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/chain_model.h"
#include "chain_tracker/chain/chain_state.h"
#include "chain_tracker/chain/object_shape.h"
#include "line_ends.h"
#include "past_views.h"

namespace chain_tracker {

class SecondLook {
 public:
  /// `initial`: the object in the first frame. `search` and `shape` must live as long.
  SecondLook(const ChainModel& model, const ChainLayout& layout, const cv::Size& image_size,
             const ChainState& initial, ChainSearch& search, ObjectShape& shape);
  SecondLook(const SecondLook&) = delete;
  SecondLook& operator=(const SecondLook&) = delete;

  /// Of the parts [px], between two frames.
  double searchRadius() const { return reach(0, 0.0); }

  /// The image that is looked at from now on; it must live as long.
  void show(const cv::Mat& image) { image_ = image; }

  /// To be called with what was found around the place of `before`, the state of the last frame.
  /// If there is reason to doubt it, or some segments are hidden, `found` becomes another chain
  /// that is clearly more like the object, if there is one. Each frame in doubt tries something
  /// else.
  void reconsider(const ChainState& before, FoundChain& found);

  /// Looks for an object that is lost since `frames_lost` frames: what is most like it.
  FoundChain findLost(int frames_lost);

  /// To be called with every chain that was taken for the object.
  void observe(const FoundChain& found);

 private:
  /// A line that was in doubt stays so for longer.
  bool isDoubtful(const FoundChain& found) const;
  void preferBetter(FoundChain other, FoundChain& found) const;
  void preferLook(FoundChain other, FoundChain& found) const;
  void preferBetter(FoundChain other, double gain, FoundChain& found) const;
  double reach(int failures, double widest) const;
  FoundChain find(const ChainState& sought, const SearchRange& range);

  void lookElsewhere(const ChainState& before, FoundChain& found);
  FoundChain look(int failures, double widest, double least);
  FoundChain turned(int side, const ChainState& before);
  FoundChain halfTurned(const FoundChain& found);
  FoundChain refitted(FoundChain found, double least);
  void tryEnds(FoundChain& found);
  void learnEnds(const FoundChain& found);
  void seekEnds();
  void preferOtherEnds(FoundChain& found);
  bool align(FoundChain& found);
  void tryOtherBends(FoundChain& found);
  void takeHeldSegments(const ChainState& found);

  ChainModel model_;
  bool is_line_;  ///< it bends anywhere, and often looks the same all along
  bool is_open_line_;
  bool is_uniform_line_;
  bool tries_ends_;
  cv::Size image_size_;
  cv::Mat image_;
  ChainSearch& search_;
  ObjectShape& shape_;
  ChainState trusted_;  ///< when the object was last seen for sure
  PastViews past_views_;
  int frame_ = 0;  ///< of the kFramesPerLook from one look to the next
  int frames_doubted_ = 0;
  LineEnds ends_;
  bool knows_ends_ = false;
  bool tells_length_ = true;  ///< by its ends
  // Of the line that is tried elsewhere along itself.
  ChainState sought_;
  FoundChain other_;
  std::vector<bool> is_held_;  ///< of the segments: where they were found
};

}  // namespace chain_tracker
