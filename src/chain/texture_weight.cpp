// SPDX-License-Identifier: BSD-3-Clause
#include "texture_weight.h"

#include <algorithm>
#include <cstddef>

namespace chain_tracker {
namespace {

/// Mean length of textures. Windows of a thread hold its outline, or what marks it: 0.91 and more.
/// Those within a body hold little but noise: 0.83 and less.
constexpr double kFlat = 0.87;
/// What is flat inside has the same colours wherever a window lies in it. Its texture tells when
/// one reaches beyond the outline, and no background disturbs it until then.
constexpr double kFlatBody = 4.0;
/// Side of its windows, of its length. What is thinner has few pixels to a window, and those beyond
/// its ends are another blur in every frame: it would draw back from them.
constexpr double kThick = 0.04;

bool isThickBody(const SegmentLayout& segment) {
  return segment.layout == Layout::kDeformable &&
         segment.parts.front().side >= kThick * chainLengthOf(segment);
}

/// Of `parts` windows; 1 if none is known.
double meanTexture(size_t parts, ObjectAppearance& learned) {
  double sum = 0.0;
  double weights = 0.0;
  for (size_t k = 0; k < parts; ++k) {
    const PartAppearance& part = learned.part(k, 0.0);
    sum += double(part.known) * strengthOf(part.texture);
    weights += double(part.known);
  }
  return weights > 0.0 ? sum / weights : 1.0;
}

}  // namespace

AppearanceModel withMeasuredTexture(AppearanceModel model, const ChainLayout& layout,
                                    ObjectAppearance& learned) {
  size_t parts = 0;
  for (const SegmentLayout& segment : layout.segments) parts += segment.parts.size();
  const bool is_thick = std::all_of(layout.segments.begin(), layout.segments.end(), isThickBody);
  if (is_thick && meanTexture(parts, learned) < kFlat) model.haar_weight *= kFlatBody;
  return model;
}

}  // namespace chain_tracker
