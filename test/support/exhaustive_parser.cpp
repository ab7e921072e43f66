// SPDX-License-Identifier: BSD-3-Clause
#include "support/exhaustive_parser.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "chain_tracker/haar/parser.h"
#include "haar/kernel_factors.h"

namespace chain_tracker::exhaustive {
namespace {

using haar::SparseKernel;
using Place = std::pair<int, int>;
using Places = std::vector<Place>;  ///< sorted, each once

Places sorted(Places places) {
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

Places placesOf(const SparseKernel& kernel) {
  Places places;
  for (const haar::KernelTap& tap : kernel.taps()) places.emplace_back(tap.dx, tap.dy);
  return sorted(places);
}

/// The smallest union of some sets of places, each shifted in any way.
class SmallestUnion {
 public:
  explicit SmallestUnion(std::vector<Places> sets) : rest_(std::move(sets)) {
    std::sort(rest_.begin(), rest_.end(),
              [](const Places& a, const Places& b) { return a.size() < b.size(); });
    const Places largest = rest_.back();
    rest_.pop_back();
    extend(largest, std::vector<bool>(rest_.size(), true));
  }

  std::int64_t size() const { return static_cast<std::int64_t>(best_); }

 private:
  using UnionsByShift = std::map<Place, Places>;

  /// Adds every set of the rest at every shift at which it meets what is there.
  void extend(const Places& placed, std::vector<bool> is_left) {
    std::vector<UnionsByShift> unions(rest_.size());
    for (size_t i = 0; i < rest_.size(); ++i) {
      if (!is_left[i]) continue;
      unions[i] = unionsOf(placed, rest_[i]);
      const size_t smallest = smallestOf(unions[i]);
      if (smallest >= best_) return;  // the set needs that many places, whatever comes before it
      is_left[i] = smallest > placed.size();  // else it is there already
    }
    if (!visited_.emplace(placed, is_left).second) return;
    if (std::find(is_left.begin(), is_left.end(), true) == is_left.end()) {
      best_ = std::min(best_, placed.size());
    }
    for (size_t i = 0; i < rest_.size(); ++i) {
      if (!is_left[i]) continue;
      std::vector<bool> others = is_left;
      others[i] = false;
      for (const auto& entry : unions[i]) {
        if (entry.second.size() < best_) extend(entry.second, others);
      }
    }
  }

  static UnionsByShift unionsOf(const Places& placed, const Places& next) {
    UnionsByShift unions;
    for (const Place& to : placed) {
      for (const Place& from : next) {
        const Place shift(to.first - from.first, to.second - from.second);
        Places& all = unions[shift];
        if (!all.empty()) continue;
        all = placed;
        for (const Place& p : next)
          all.emplace_back(p.first + shift.first, p.second + shift.second);
        all = sorted(all);
      }
    }
    return unions;
  }

  static size_t smallestOf(const UnionsByShift& unions) {
    size_t smallest = std::numeric_limits<size_t>::max();
    for (const auto& entry : unions) smallest = std::min(smallest, entry.second.size());
    return smallest;
  }

  std::vector<Places> rest_;  ///< all but the largest, which stays where it is
  size_t best_ = std::numeric_limits<size_t>::max();
  std::set<std::pair<Places, std::vector<bool>>> visited_;
};

/// Products of every choice of factors that the space allows, found one factor at a time.
std::set<SparseKernel> divisorsOf(const SparseKernel& kernel,
                                  const haar::DifferenceDelays& delays) {
  std::set<SparseKernel> products = {SparseKernel::one()};
  for (const SparseKernel& factor : haar::factorsOf(kernel, delays)) {
    const std::set<SparseKernel> before = products;
    for (const SparseKernel& product : before) products.insert(product * factor);
  }
  std::set<SparseKernel> divisors;
  for (const SparseKernel& product : products) {
    const bool is_small = product.size() <= kernel.size() &&
                          kernel.dividedBy(product).value().size() <= kernel.size();
    if (is_small) divisors.insert(product);
  }
  return divisors;
}

class Enumeration {
 public:
  Enumeration(const haar::FeatureEnsemble& ensemble, std::int64_t at_most)
      : best_(at_most + 1), accesses_(static_cast<std::int64_t>(ensemble.size())) {
    haar::DifferenceDelays delays;
    std::set<SparseKernel> targets;
    for (const haar::AlignedKernel& kernel : haar::alignedKernels(ensemble)) {
      haar::DifferenceDelays more = haar::differenceDelays(kernel.primitive);
      delays.x.merge(more.x);
      delays.y.merge(more.y);
      targets.insert(kernel.primitive);
    }
    std::set<SparseKernel> kernels = {SparseKernel::one()};
    for (const SparseKernel& target : targets) kernels.merge(divisorsOf(target, delays));
    kernels_.assign(kernels.begin(), kernels.end());
    for (const SparseKernel& target : targets) targets_.push_back(numberOf(target));
    one_ = numberOf(SparseKernel::one());
    for (const SparseKernel& child : kernels_) ways_.push_back(waysTo(child));
    parents_.assign(kernels_.size(), kNone);
    passes_.resize(kernels_.size());
  }

  std::int64_t fewest() {
    add(0);
    return best_;
  }

 private:
  static constexpr size_t kNone = std::numeric_limits<size_t>::max();

  /// From which kernel a kernel can be computed, and what that reads.
  struct Way {
    size_t parent = 0;
    int places = 0;  ///< number of a set of places
  };

  size_t numberOf(const SparseKernel& kernel) const {
    const auto place = std::lower_bound(kernels_.begin(), kernels_.end(), kernel);
    return static_cast<size_t>(place - kernels_.begin());
  }

  std::vector<Way> waysTo(const SparseKernel& child) {
    std::vector<Way> ways;
    for (const SparseKernel& parent : kernels_) {
      const auto edge = child.dividedBy(parent);
      if (edge && !(child == parent)) ways.push_back({numberOf(parent), numberOf(placesOf(*edge))});
    }
    return ways;
  }

  int numberOf(const Places& places) {
    const auto known = std::find(places_.begin(), places_.end(), places);
    if (known != places_.end()) return static_cast<int>(known - places_.begin());
    places_.push_back(places);
    return static_cast<int>(places_.size()) - 1;
  }

  void add(size_t target) {
    if (target < targets_.size()) return climb(target, targets_[target]);
    best_ = std::min(best_, accesses_);
  }

  /// Every way from a kernel up to the integral image, or to what is there already.
  void climb(size_t target, size_t kernel) {
    if (accesses_ >= best_) return;
    if (kernel == one_ || parents_[kernel] != kNone) return add(target + 1);
    for (const Way& way : ways_[kernel]) {
      std::vector<int>& pass = passes_[way.parent];
      const std::vector<int> pass_before = pass;
      const std::int64_t accesses_before = accesses_;
      pass.insert(std::upper_bound(pass.begin(), pass.end(), way.places), way.places);
      accesses_ += accessesOf(pass, way.parent) - accessesOf(pass_before, way.parent);
      parents_[kernel] = way.parent;
      climb(target, way.parent);
      parents_[kernel] = kNone;
      accesses_ = accesses_before;
      pass = pass_before;
    }
  }

  /// Reads of a pass, and the write of what it reads.
  std::int64_t accessesOf(const std::vector<int>& pass, size_t parent) {
    if (pass.empty()) return 0;
    const auto [entry, is_new] = reads_.try_emplace(pass, 0);
    if (is_new) {
      std::vector<Places> sets;
      sets.reserve(pass.size());
      for (const int number : pass) sets.push_back(places_[static_cast<size_t>(number)]);
      entry->second = SmallestUnion(sets).size();
    }
    return entry->second + (parent == one_ ? 0 : 1);
  }

  std::int64_t best_;
  std::int64_t accesses_;              ///< of the tree so far, and the writes of all features
  std::vector<SparseKernel> kernels_;  ///< of the space, sorted; numbers below are places here
  size_t one_ = 0;
  std::vector<size_t> targets_;
  std::vector<std::vector<Way>> ways_;
  std::vector<size_t> parents_;
  std::vector<std::vector<int>> passes_;  ///< numbers of what the children read, sorted
  std::vector<Places> places_;
  std::map<std::vector<int>, std::int64_t> reads_;
};

}  // namespace

std::int64_t fewestAccesses(const haar::FeatureEnsemble& ensemble, std::int64_t at_most) {
  return Enumeration(ensemble, at_most).fewest();
}

}  // namespace chain_tracker::exhaustive
