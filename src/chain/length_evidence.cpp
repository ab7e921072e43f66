// SPDX-License-Identifier: BSD-3-Clause
#include "length_evidence.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace chain_tracker {
namespace {

/// Mean distance up to which a line is of one colour, as noise and shades make it, and from which
/// on its parts tell its length. Drawn lines of one colour are at 0.01 to 0.14, lines with marks
/// and the bodies of fish at 0.34 to 0.76.
constexpr double kUniform = 0.15;
constexpr double kMarked = 0.3;
/// Rendered cables without marks, whose shades differ, are at 0.42 to 0.54, sutures with marks at
/// 0.38 to 0.49, cables with marks at 0.75 to 0.78, fish at 0.63 to 0.74.
constexpr double kClearlyMarked = 0.6;

/// Root of 1 - the Bhattacharyya coefficient, as costs are.
double distance(const RootHistogram& a, const RootHistogram& b) {
  const double alike = std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
  return std::sqrt(std::max(0.0, 1.0 - alike));
}

/// Of parts so far apart, along all of the line; 0 if it is no longer than that.
double meanDistance(const std::vector<RootHistogram>& colors, size_t apart) {
  if (colors.size() <= apart) return 0.0;
  const size_t pairs = colors.size() - apart;
  double sum = 0.0;
  for (size_t k = 0; k < pairs; ++k) sum += distance(colors[k], colors[k + apart]);
  return sum / static_cast<double>(pairs);
}

double distanceApart(const std::vector<RootHistogram>& colors) {
  // Neighbours show some of the same pixels, and marks may come back at any one distance.
  const size_t sixth = std::max<size_t>(1, colors.size() / 6);
  const size_t quarter = std::max<size_t>(1, colors.size() / 4);
  return std::max({meanDistance(colors, sixth), meanDistance(colors, sixth + 1),
                   meanDistance(colors, quarter)});
}

}  // namespace

double lengthEvidence(const std::vector<RootHistogram>& colors) {
  return std::clamp((distanceApart(colors) - kUniform) / (kMarked - kUniform), 0.0, 1.0);
}

bool isClearlyMarked(const std::vector<RootHistogram>& colors) {
  return distanceApart(colors) >= kClearlyMarked;
}

}  // namespace chain_tracker
