// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/haar/sparse_kernel.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <numeric>
#include <stdexcept>
#include <tuple>

namespace chain_tracker::haar {
namespace {

std::string powerText(char name, int power) {
  if (power == 0) return "";
  return power == 1 ? std::string(1, name) : name + ("^" + std::to_string(power));
}

std::string monomialText(const KernelTap& tap) {
  const std::string x = powerText('X', tap.dx);
  const std::string y = powerText('Y', tap.dy);
  const std::string shift = x + (x.empty() || y.empty() ? "" : " ") + y;
  const std::int64_t size = std::abs(tap.weight);
  if (shift.empty()) return std::to_string(size);
  return size == 1 ? shift : std::to_string(size) + " " + shift;
}

}  // namespace

bool KernelTap::operator<(const KernelTap& other) const {
  return std::tie(dy, dx, weight) < std::tie(other.dy, other.dx, other.weight);
}

SparseKernel::SparseKernel(std::vector<KernelTap> taps) {
  std::sort(taps.begin(), taps.end());
  for (const KernelTap& tap : taps) {
    if (!taps_.empty() && taps_.back().dx == tap.dx && taps_.back().dy == tap.dy) {
      taps_.back().weight += tap.weight;
    } else {
      taps_.push_back(tap);
    }
  }
  taps_.erase(std::remove_if(taps_.begin(), taps_.end(),
                             [](const KernelTap& tap) { return tap.weight == 0; }),
              taps_.end());
}

SparseKernel SparseKernel::one() { return SparseKernel({{0, 0, 1}}); }
SparseKernel SparseKernel::differenceX(int delay) {
  return SparseKernel({{0, 0, 1}, {0, delay, -1}});
}
SparseKernel SparseKernel::differenceY(int delay) {
  return SparseKernel({{0, 0, 1}, {delay, 0, -1}});
}

cv::Point SparseKernel::minDelay() const {
  if (isZero()) return {};
  cv::Point low(taps_.front().dx, taps_.front().dy);
  for (const KernelTap& tap : taps_) low.x = std::min(low.x, tap.dx);
  return low;
}

cv::Point SparseKernel::maxDelay() const {
  if (isZero()) return {};
  cv::Point high(taps_.back().dx, taps_.back().dy);
  for (const KernelTap& tap : taps_) high.x = std::max(high.x, tap.dx);
  return high;
}

SparseKernel SparseKernel::shifted(const cv::Point& delay) const {
  SparseKernel result = *this;
  for (KernelTap& tap : result.taps_) {
    tap.dx += delay.x;
    tap.dy += delay.y;
  }
  return result;
}

SparseKernel SparseKernel::scaled(std::int64_t factor) const {
  std::vector<KernelTap> taps = taps_;
  for (KernelTap& tap : taps) tap.weight *= factor;
  return SparseKernel(std::move(taps));
}

SparseKernel SparseKernel::operator*(const SparseKernel& other) const {
  std::vector<KernelTap> taps;
  taps.reserve(size() * other.size());
  for (const KernelTap& a : taps_) {
    for (const KernelTap& b : other.taps_) {
      taps.push_back({a.dy + b.dy, a.dx + b.dx, a.weight * b.weight});
    }
  }
  return SparseKernel(std::move(taps));
}

SparseKernel SparseKernel::operator+(const SparseKernel& other) const {
  std::vector<KernelTap> taps = taps_;
  taps.insert(taps.end(), other.taps_.begin(), other.taps_.end());
  return SparseKernel(std::move(taps));
}

std::optional<SparseKernel> SparseKernel::dividedBy(const SparseKernel& divisor) const {
  const KernelTap lead = divisor.taps_.front();
  const cv::Point high = maxDelay() - divisor.maxDelay();
  const int low_x = minDelay().x - divisor.minDelay().x;
  std::map<std::pair<int, int>, std::int64_t> rest;
  for (const KernelTap& tap : taps_) rest[{tap.dy, tap.dx}] = tap.weight;
  std::vector<KernelTap> quotient;
  while (!rest.empty()) {
    const auto [place, weight] = *rest.begin();
    if (weight % lead.weight != 0) return std::nullopt;
    const KernelTap tap{place.first - lead.dy, place.second - lead.dx, weight / lead.weight};
    if (tap.dy > high.y || tap.dx > high.x || tap.dx < low_x) return std::nullopt;
    quotient.push_back(tap);
    for (const KernelTap& d : divisor.taps_) {
      const auto entry = rest.try_emplace({tap.dy + d.dy, tap.dx + d.dx}, 0).first;
      entry->second -= tap.weight * d.weight;
      if (entry->second == 0) rest.erase(entry);
    }
  }
  return SparseKernel(std::move(quotient));
}

std::string SparseKernel::text() const {
  if (isZero()) return "0";
  std::string text;
  for (const KernelTap& tap : taps_) {
    const bool negative = tap.weight < 0;
    if (text.empty()) {
      text = negative ? "-" : "";
    } else {
      text += negative ? " - " : " + ";
    }
    text += monomialText(tap);
  }
  return text;
}

AlignedKernel alignedKernel(const SparseKernel& kernel) {
  std::int64_t divisor = 0;
  for (const KernelTap& tap : kernel.taps()) divisor = std::gcd(divisor, tap.weight);
  if (divisor == 0) throw std::invalid_argument("the zero kernel cannot be aligned");
  AlignedKernel aligned;
  aligned.delay = kernel.minDelay();
  aligned.scale = kernel.taps().front().weight < 0 ? -divisor : divisor;
  std::vector<KernelTap> taps = kernel.taps();
  for (KernelTap& tap : taps) {
    tap.dx -= aligned.delay.x;
    tap.dy -= aligned.delay.y;
    tap.weight /= aligned.scale;
  }
  aligned.primitive = SparseKernel(std::move(taps));
  return aligned;
}

}  // namespace chain_tracker::haar
