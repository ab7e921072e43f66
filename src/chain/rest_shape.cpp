// SPDX-License-Identifier: BSD-3-Clause
#include "rest_shape.h"

#include <cstddef>

#include "chain_tracker/image/pixel_geometry.h"

namespace chain_tracker {
namespace {

/// Share of the way that what is hidden gives way in a frame: most of it within ten frames, while a
/// part that is taken for hidden once stays as it was.
constexpr double kRelaxation = 0.3;

/// Directions of the hidden edges in [first, last), led on from the seen edges beside them.
std::vector<double> ledOn(size_t first, size_t last, const std::vector<double>& seen,
                          const std::vector<double>& turns) {
  std::vector<double> led(last - first);
  if (first == 0) {
    double direction = seen[last];
    for (size_t k = last; k-- > 0;) led[k] = direction -= turns[k + 1];
    return led;
  }
  double direction = seen[first - 1];
  for (size_t k = first; k < last; ++k) led[k - first] = direction += turns[k];
  if (last == seen.size()) return led;
  const double missing = wrapAngle(seen[last] - direction - turns[last]);
  const auto gaps = static_cast<double>(led.size() + 1);
  for (size_t i = 0; i < led.size(); ++i) led[i] += missing * static_cast<double>(i + 1) / gaps;
  return led;
}

}  // namespace

std::vector<double> restDirections(const std::vector<double>& before,
                                   const std::vector<bool>& is_hidden,
                                   const std::vector<double>& turns) {
  std::vector<double> rest = before;
  const size_t edges = before.size();
  for (size_t first = 0; first < edges; ++first) {
    if (!is_hidden[first]) continue;
    size_t last = first;
    while (last < edges && is_hidden[last]) ++last;
    if (first == 0 && last == edges) break;
    const std::vector<double> led = ledOn(first, last, before, turns);
    for (size_t k = first; k < last; ++k) {
      rest[k] = wrapAngle(before[k] + kRelaxation * wrapAngle(led[k - first] - before[k]));
    }
    first = last;
  }
  return rest;
}

}  // namespace chain_tracker
