// SPDX-License-Identifier: BSD-3-Clause
/// The configurable model of an object (thesis ch. 3.2-3.3): everything that is known before the
/// first image. One model serves all objects; only these numbers differ.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace chain_tracker {

/// A half turn to either side [rad]: a joint with these limits has none.
constexpr double kFreeJoint = 3.14159265358979323846;

/// How the parts of a segment are laid out over the shape that initialises it.
enum class Layout {
  kElongated,   ///< square cells over a long rectangle: its two ends and `aspect`, or four corners
  kPlanar,      ///< square cells over a rectangle given by its four corners; not in a joined chain
  kDeformable,  ///< equal steps along a polyline
  kPoints,      ///< the points given, which keep their arrangement; not in a joined chain
};

/// Whether parts fill a rectangle.
inline bool isGrid(Layout layout) {
  return layout == Layout::kElongated || layout == Layout::kPlanar;
}

/// One segment: a chain of parts that turns and rescales as one (thesis ch. 3.2.2).
struct SegmentModel {
  std::string name = "body";
  Layout layout = Layout::kElongated;
  /// Wanted number of parts; a grid of cells comes as near as it can. kPoints has as many as it is
  /// given.
  int parts = 24;
  /// Width over length of an elongated object given by its two ends, and of the stroke along a
  /// deformable one from which its colours are learned.
  double aspect = 0.4;
  /// The first image decides on the aspect of a link, if it shows it; see link_width.h.
  bool measure_aspect = false;
  /// How far a grid of cells reaches beyond the outline, so that windows straddle it: fraction of
  /// the square root of the area. Means nothing to other layouts.
  double margin = 0.1;
  /// The first image decides on the windows of a deformable segment, and on how many parts they
  /// leave room for, if what it lies on is thicker than they are; see line_width.h.
  bool measure_window = false;
  double window = 1.15;         ///< window side over cell side, or over the step along the polyline
  double stretch_sigma = 0.05;  ///< standard deviation of an edge's length, fraction of the length
  /// Standard deviation of an edge's angular displacement [rad]: from the shape laid out; of a
  /// deformable segment, which keeps no shape, from that of the frame before.
  double bend_sigma = 0.1;
  /// How far a deformable segment goes back to the bends of the first frame where it is hidden: 0
  /// straightens, 1 takes them up.
  double shape_memory = 0.0;
  int orientation_hypotheses = 5;  ///< odd; orientations tried around the previous one
  double orientation_step = 0.1;   ///< between neighbouring orientation hypotheses [rad]
  double orientation_sigma = 0.1;  ///< of the turn between two frames [rad]
  int scale_hypotheses = 3;        ///< odd; scales tried around the previous one
  double scale_step = 0.03;        ///< between neighbouring scale hypotheses, log scale
  double scale_sigma = 0.03;       ///< of the change of log scale between two frames
};

/// The hinge between a segment and the next one (thesis ch. 3.2.2). Its angle is the orientation of
/// the next segment less that of this one: 0 where they continue straight on.
struct JointModel {
  double min_angle = -kFreeJoint;  ///< [rad]
  double max_angle = kFreeJoint;   ///< [rad]; free unless less than a half turn to both sides
};

/// What the channels learn in the first frame (thesis ch. 3.2.1).
struct AppearanceModel {
  int palette_colors = 24;        ///< colours learned from the object and the ring around it
  double ring = 0.5;              ///< width of that ring, fraction of the object's size
  double min_object_share = 0.5;  ///< a colour rarer on the object than this becomes "other"
  double weight = 8.0;            ///< of the colour cost against the springs
  double edge_weight = 16.0;      ///< of the cost of edges, in the coarse search; 0: none
  /// Of the cost of texture, in the fine search; 0: none. Four times as much for what is
  /// deformable, thick and flat inside: its colours hardly tell where in it a part lies; see
  /// texture_weight.h.
  double haar_weight = 4.0;
  /// Share of its usual confidence below which a part is taken to show something else.
  double outlier_below = 0.5;
  /// Slope of its cost from there on, of what it is before: how much what covers a part, or looks
  /// otherwise than it, still pulls it about. 1: as much as everything.
  double outlier_slope = 0.5;
  /// Share of a change of light, of its brightness and its colour, that is followed within a frame;
  /// 0: none.
  double light_rate = 0.3;
};

/// Where and when the object is looked for, and when it counts as found.
struct SearchModel {
  /// Reach of a part between frames, fraction of the image diagonal; of what is thin at most 40
  /// steps of the coarse lattice, some 5 window sides, or 13 where it has been made coarser.
  double radius = 0.06;
  double lost_below = 0.07;  ///< confidence under which a tracked object becomes LOST
  double found_above = 0.2;  ///< confidence over which a LOST object is tracked again
  /// Share of its usual confidence under which a tracked object becomes LOST, too; a LOST one needs
  /// a fifth more to be tracked again. 0: the confidence alone counts.
  double lost_share = 0.25;
  double occluded_below = 0.25;  ///< confidence under which a part counts as hidden
  /// Cost of a part that moves by `radius` between two frames: keeps what is hidden in place.
  double travel_weight = 1.0;
  /// Share of the usual likeness, by all channels, below which the object is looked for elsewhere,
  /// too, and has to have there; 0: never.
  double doubt_below = 0.7;
};

/// Several segments are joined end to end at the vertices of the polyline that initialises them.
struct ChainModel {
  std::string name = "bottle";
  std::vector<SegmentModel> segments = {SegmentModel()};
  std::vector<JointModel> joints;  ///< one fewer than segments, or empty: all free
  /// The one segment stands for every edge of the polyline given, however many there are.
  bool segment_per_edge = false;
  AppearanceModel appearance;
  SearchModel search;
};

/// The model with a segment for every edge of a polyline of `points` points, named after the one
/// segment and counted from 1, if it is one of `segment_per_edge`; any other model as it is.
ChainModel forPolyline(ChainModel model, size_t points);

/// The joint behind segment `segment`, which is not the last one.
JointModel jointOf(const ChainModel& model, size_t segment);

/// Every fault of the model, one sentence each: it begins with the key, then its value and what is
/// allowed; empty if the model can be used.
std::vector<std::string> faultsOf(const ChainModel& model);

}  // namespace chain_tracker
