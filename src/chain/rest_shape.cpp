// SPDX-License-Identifier: BSD-3-Clause
#include "rest_shape.h"

#include <cstddef>

#include "chain_tracker/image/pixel_geometry.h"

namespace chain_tracker {
namespace {

/// Share of the way that what is hidden gives way in a frame: most of it within ten frames, while a
/// part that is taken for hidden once stays as it was.
constexpr double kRelaxation = 0.3;

/// The hidden edges in [first, last) become those that lead on from the seen edges beside them.
void leadOn(size_t first, size_t last, const std::vector<double>& turns,
            std::vector<double>& directions) {
  if (first == 0) {
    for (size_t k = last; k-- > 0;) directions[k] = directions[k + 1] - turns[k + 1];
    return;
  }
  for (size_t k = first; k < last; ++k) directions[k] = directions[k - 1] + turns[k];
  if (last == directions.size()) return;
  const double missing = wrapAngle(directions[last] - directions[last - 1] - turns[last]);
  const auto gaps = static_cast<double>(last - first + 1);
  for (size_t k = first; k < last; ++k) {
    directions[k] += missing * static_cast<double>(k - first + 1) / gaps;
  }
}

}  // namespace

void restDirections(const std::vector<double>& before, const std::vector<bool>& is_hidden,
                    const std::vector<double>& turns, std::vector<double>& rest) {
  rest = before;
  const size_t edges = before.size();
  for (size_t first = 0; first < edges; ++first) {
    if (!is_hidden[first]) continue;
    size_t last = first;
    while (last < edges && is_hidden[last]) ++last;
    if (first == 0 && last == edges) break;
    leadOn(first, last, turns, rest);
    for (size_t k = first; k < last; ++k) {
      rest[k] = wrapAngle(before[k] + kRelaxation * wrapAngle(rest[k] - before[k]));
    }
    first = last;
  }
}

}  // namespace chain_tracker
