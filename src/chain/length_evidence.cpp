// SPDX-License-Identifier: BSD-3-Clause
#include "length_evidence.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace chain_tracker {
namespace {

/// Of the parts, from one to the one it is held against: neighbours show some of the same pixels.
constexpr size_t kPartsPerPair = 6;
/// Mean distance up to which a line is of one colour, as noise and shades make it, and from which
/// on its parts tell its length. Rendered lines of one colour are at 0.06 to 0.08, lines with marks
/// and the bodies of fish at 0.34 to 0.76.
constexpr double kUniform = 0.1;
constexpr double kMarked = 0.3;

/// Root of 1 - the Bhattacharyya coefficient, as costs are.
double distance(const RootHistogram& a, const RootHistogram& b) {
  const double alike = std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
  return std::sqrt(std::max(0.0, 1.0 - alike));
}

}  // namespace

double lengthEvidence(const std::vector<RootHistogram>& colors) {
  if (colors.size() < 2) return 1.0;
  const size_t apart = std::max<size_t>(1, colors.size() / kPartsPerPair);
  const size_t pairs = colors.size() - apart;
  double sum = 0.0;
  for (size_t k = 0; k < pairs; ++k) sum += distance(colors[k], colors[k + apart]);
  const double mean = sum / static_cast<double>(pairs);
  return std::clamp((mean - kUniform) / (kMarked - kUniform), 0.0, 1.0);
}

}  // namespace chain_tracker
