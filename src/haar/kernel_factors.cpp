// SPDX-License-Identifier: BSD-3-Clause
#include "kernel_factors.h"

#include <algorithm>
#include <map>

namespace chain_tracker::haar {
namespace {

enum class Axis { kX, kY };

SparseKernel difference(Axis axis, int delay) {
  return axis == Axis::kX ? SparseKernel::differenceX(delay) : SparseKernel::differenceY(delay);
}

/// 1 + D + D^2 + .. (terms), D = X^delay or Y^delay.
SparseKernel sum(Axis axis, int delay, int terms) {
  std::vector<KernelTap> taps;
  taps.reserve(static_cast<size_t>(terms));
  for (int i = 0; i < terms; ++i) {
    taps.push_back(axis == Axis::kX ? KernelTap{0, i * delay, 1} : KernelTap{i * delay, 0, 1});
  }
  return SparseKernel(std::move(taps));
}

int extent(Axis axis, const SparseKernel& kernel) {
  return axis == Axis::kX ? kernel.maxDelay().x : kernel.maxDelay().y;
}

/// Whether 1 - sign D^delay divides the kernel: D^delay = sign must make it vanish.
bool divides(Axis axis, int delay, int sign, const SparseKernel& kernel) {
  std::map<std::pair<int, int>, std::int64_t> lines;  // line across the axis, place modulo delay
  for (const KernelTap& tap : kernel.taps()) {
    const int place = axis == Axis::kX ? tap.dx : tap.dy;
    const int line = axis == Axis::kX ? tap.dy : tap.dx;
    const bool is_negated = sign < 0 && place / delay % 2 != 0;
    lines[{line, place % delay}] += is_negated ? -tap.weight : tap.weight;
  }
  return std::all_of(lines.begin(), lines.end(), [](const auto& sum) { return sum.second == 0; });
}

/// Divides by 1 - sign D^delay as often as that leaves no more taps; the number of times.
int divideOut(Axis axis, int delay, int sign, SparseKernel& kernel) {
  const SparseKernel factor = sign > 0 ? difference(axis, delay) : sum(axis, delay, 2);
  int times = 0;
  while (divides(axis, delay, sign, kernel)) {
    const std::optional<SparseKernel> quotient = kernel.dividedBy(factor);
    if (!quotient || quotient->size() > kernel.size()) break;
    kernel = *quotient;
    ++times;
  }
  return times;
}

/// Delays of the differences along an axis that divide the kernel, the longest first; they are
/// taken out of it.
std::vector<int> takeDifferences(Axis axis, SparseKernel& kernel) {
  std::vector<int> delays;
  for (int delay = extent(axis, kernel); delay > 0; --delay) {
    delays.insert(delays.end(), static_cast<size_t>(divideOut(axis, delay, 1, kernel)), delay);
  }
  return delays;
}

void takeSums(Axis axis, SparseKernel& kernel, std::vector<SparseKernel>& factors) {
  for (int delay = extent(axis, kernel); delay > 0; --delay) {
    const int times = divideOut(axis, delay, -1, kernel);
    factors.insert(factors.end(), static_cast<size_t>(times), sum(axis, delay, 2));
  }
}

/// 1 - D^delay, split where the ensemble has a half or a third of the delay.
void splitDifference(Axis axis, int delay, const std::set<int>& delays,
                     std::vector<SparseKernel>& factors) {
  for (const int terms : {2, 3}) {
    if (delay % terms != 0 || delays.count(delay / terms) == 0) continue;
    factors.push_back(sum(axis, delay / terms, terms));
    splitDifference(axis, delay / terms, delays, factors);
    return;
  }
  factors.push_back(difference(axis, delay));
}

/// A product of a kernel in X and one in Y has the taps of its first row times those of its first
/// column.
void takeRest(const SparseKernel& rest, std::vector<SparseKernel>& factors) {
  if (rest == SparseKernel::one()) return;
  std::vector<KernelTap> row;
  std::vector<KernelTap> column;
  for (const KernelTap& tap : rest.taps()) {
    if (tap.dy == 0) row.push_back(tap);
    if (tap.dx == rest.taps().front().dx) column.push_back(tap);
  }
  const SparseKernel in_x = alignedKernel(SparseKernel(row)).primitive;
  const SparseKernel in_y = alignedKernel(SparseKernel(column)).primitive;
  if (in_x.size() > 1 && in_y.size() > 1 && in_x * in_y == rest) {
    factors.push_back(in_x);
    factors.push_back(in_y);
  } else {
    factors.push_back(rest);
  }
}

/// Products of sub-multisets of the factors.
std::set<SparseKernel> productsOf(const std::vector<SparseKernel>& factors) {
  std::map<SparseKernel, int> counts;
  for (const SparseKernel& factor : factors) ++counts[factor];
  std::set<SparseKernel> products = {SparseKernel::one()};
  for (const auto& [factor, count] : counts) {
    std::set<SparseKernel> more;
    for (SparseKernel product : products) {
      more.insert(product);
      for (int i = 0; i < count; ++i) more.insert(product = product * factor);
    }
    products = std::move(more);
  }
  return products;
}

size_t countProducts(const std::vector<SparseKernel>& factors) {
  std::map<SparseKernel, size_t> counts;
  for (const SparseKernel& factor : factors) ++counts[factor];
  size_t products = 1;
  for (const auto& entry : counts) products *= entry.second + 1;
  return products;
}

}  // namespace

DifferenceDelays differenceDelays(const SparseKernel& kernel) {
  SparseKernel rest = kernel;
  const std::vector<int> x = takeDifferences(Axis::kX, rest);
  const std::vector<int> y = takeDifferences(Axis::kY, rest);
  return {{x.begin(), x.end()}, {y.begin(), y.end()}};
}

std::vector<SparseKernel> factorsOf(const SparseKernel& kernel, const DifferenceDelays& delays) {
  SparseKernel rest = kernel;
  std::vector<SparseKernel> factors;
  for (const int delay : takeDifferences(Axis::kX, rest)) {
    splitDifference(Axis::kX, delay, delays.x, factors);
  }
  for (const int delay : takeDifferences(Axis::kY, rest)) {
    splitDifference(Axis::kY, delay, delays.y, factors);
  }
  takeSums(Axis::kX, rest, factors);
  takeSums(Axis::kY, rest, factors);
  takeRest(rest, factors);
  return factors;
}

std::vector<SparseKernel> properDivisors(const SparseKernel& kernel,
                                         const DifferenceDelays& delays) {
  std::vector<SparseKernel> factors = factorsOf(kernel, delays);
  if (countProducts(factors) > kMaxProducts) factors = factorsOf(kernel, {});
  if (countProducts(factors) > kMaxProducts) return {};
  std::vector<SparseKernel> divisors;
  for (const SparseKernel& product : productsOf(factors)) {
    if (product == SparseKernel::one() || product == kernel) continue;
    if (product.size() > kernel.size()) continue;
    const std::optional<SparseKernel> rest = kernel.dividedBy(product);
    if (rest && rest->size() <= kernel.size()) divisors.push_back(product);
  }
  return divisors;
}

}  // namespace chain_tracker::haar
