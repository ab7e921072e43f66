// SPDX-License-Identifier: BSD-3-Clause
#include "support/state_text.h"

#include <ostream>
#include <sstream>

namespace chain_tracker {
namespace {

void write(std::ostream& out, const PartState& part) {
  out << "part at " << part.position << ", orientation " << part.orientation << ", side "
      << part.side << ", confidence " << part.confidence << ", visible " << part.visible
      << ", covariance " << part.covariance << "\n";
}

void write(std::ostream& out, const SegmentState& segment) {
  const Similarity& pose = segment.image_from_segment;
  out << "segment " << segment.name << " at " << pose.translation << ", angle " << pose.angle
      << ", scale " << pose.scale << ", confidence " << segment.confidence << ", parts "
      << segment.first_part << " + " << segment.part_count << "\n";
}

void write(std::ostream& out, const CarriedPoint& point) {
  out << "point at " << point.position << ", confidence " << point.confidence << ", visible "
      << point.visible << "\n";
}

}  // namespace

std::string textOf(const ChainState& state) {
  std::ostringstream out;
  out.precision(17);
  out << toString(state.status) << ", confidence " << state.confidence << "\n";
  for (const PartState& part : state.parts) write(out, part);
  for (const SegmentState& segment : state.segments) write(out, segment);
  for (const CarriedPoint& point : state.points) write(out, point);
  for (const cv::Point2d& corner : state.outline) out << "corner " << corner << "\n";
  out << "box " << state.box << "\n";
  return out.str();
}

}  // namespace chain_tracker
