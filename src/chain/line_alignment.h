// SPDX-License-Identifier: BSD-3-Clause
/// Which piece of a line is where along it, when it was found to lie somewhere: a chain that bends
/// at will comes to lie on the line shifted along it, too short or the wrong way round, and each
/// looks much like the object. Its marks tell.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/chain_model.h"
#include "chain_tracker/chain/chain_state.h"
#include "chain_tracker/chain/part_costs.h"
#include "placement_search.h"
#include "voter_costs.h"

namespace chain_tracker {

class LineAlignment {
 public:
  /// `line`: in the first frame.
  LineAlignment(const SegmentLayout& line, const AppearanceModel& model,
                const cv::Size& image_size);

  /// Lays `line` along the stretch of it that is seen, and straight on beyond that, from the place,
  /// at the scale and in the direction in which its parts cost least by colours: the best of all
  /// directions, scales some 2 % apart and places half a part apart (exhaustive); in half of the
  /// calls, of those at which it does not become shorter. Nothing tells the length and the
  /// direction of a line that `is_uniform`, looking the same all along: it is merely shifted.
  /// False, with `line` as it was, if too little is seen to tell, or all that is seen lies so
  /// already, to the distance between two parts. `voters`: all its parts, in order, with windows of
  /// `side` [px]. O(parts x (cells of the map + scales x places)).
  bool align(const std::vector<Voter>& voters, double side, bool is_uniform, FramePixels& pixels,
             ChainState& line);

 private:
  struct Fit {
    double scale = 1.0;  ///< of the line as it was
    Placement placement;
  };

  void measure(const ChainState& line);
  double placeOf(int sample) const { return spacing_ * sample - margin_; }
  CellMap cellsAlong(double side) const;
  void sampleCosts(const std::vector<Voter>& voters, double side, FramePixels& pixels);
  Placement cheapestAt(double scale, int directions);
  Fit bestFit(bool is_uniform);

  AppearanceModel model_;
  cv::Rect2d image_;
  std::vector<double> first_lengths_;  ///< of the edges at scale 1 [px]
  PartCostsWorkspace workspace_;
  int turn_ = 0;
  // Of the line that is aligned [px].
  ChainState laid_;
  std::vector<double> lengths_;       ///< of the edges
  std::vector<double> places_;        ///< of the parts, from the middle of the line
  std::vector<cv::Point2d> stretch_;  ///< that is seen
  double length_ = 0.0;
  double seen_ = 0.0;                 ///< length of the stretch
  double spacing_ = 0.0;              ///< of the samples along it
  double margin_ = 0.0;               ///< sampled beyond either end of it
  std::vector<cv::Mat1f> costs_;      ///< of each part at all samples, a row
  std::vector<cv::Point2d> offsets_;  ///< of the parts from the middle [samples]
};

}  // namespace chain_tracker
