// SPDX-License-Identifier: BSD-3-Clause
#include "support/exhaustive_parser.h"

#include <algorithm>
#include <limits>
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
using Places = std::set<Place>;

Places placesOf(const SparseKernel& kernel) {
  Places places;
  for (const haar::KernelTap& tap : kernel.taps()) places.emplace(tap.dx, tap.dy);
  return places;
}

/// The smallest union of `placed` and all the `rest`, each shifted so that it meets what is there.
size_t smallestUnion(const Places& placed, const std::vector<Places>& rest, size_t best) {
  if (rest.empty()) return std::min(best, placed.size());
  for (size_t i = 0; i < rest.size(); ++i) {
    std::vector<Places> others = rest;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    Places shifts;
    for (const Place& to : placed) {
      for (const Place& from : rest[i])
        shifts.emplace(to.first - from.first, to.second - from.second);
    }
    for (const Place& shift : shifts) {
      Places all = placed;
      for (const Place& p : rest[i]) all.emplace(p.first + shift.first, p.second + shift.second);
      if (all.size() < best) best = smallestUnion(all, others, best);
    }
  }
  return best;
}

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
    if (is_small && !(product == kernel)) divisors.insert(product);
  }
  divisors.erase(SparseKernel::one());
  return divisors;
}

using Parents = std::map<SparseKernel, SparseKernel>;

std::int64_t cost(const Parents& parents, std::int64_t features) {
  std::map<SparseKernel, std::vector<Places>> passes;
  for (const auto& [child, parent] : parents) {
    passes[parent].push_back(placesOf(child.dividedBy(parent).value()));
  }
  auto accesses = features;
  for (auto& [parent, edges] : passes) {
    const Places first = edges.back();
    edges.pop_back();
    const size_t reads = smallestUnion(first, edges, std::numeric_limits<size_t>::max());
    accesses += static_cast<std::int64_t>(reads) + (parent == SparseKernel::one() ? 0 : 1);
  }
  return accesses;
}

class Enumeration {
 public:
  explicit Enumeration(const haar::FeatureEnsemble& ensemble)
      : features_(static_cast<std::int64_t>(ensemble.size())) {
    haar::DifferenceDelays delays;
    std::set<SparseKernel> targets;
    for (const haar::AlignedKernel& kernel : haar::alignedKernels(ensemble)) {
      haar::DifferenceDelays more = haar::differenceDelays(kernel.primitive);
      delays.x.merge(more.x);
      delays.y.merge(more.y);
      targets.insert(kernel.primitive);
    }
    targets_.assign(targets.begin(), targets.end());
    for (const SparseKernel& target : targets_) divisors_.push_back(divisorsOf(target, delays));
  }

  std::int64_t fewest() {
    choose(0, {});
    return best_;
  }

 private:
  void choose(size_t target, const Parents& parents) {
    if (target == targets_.size()) {
      best_ = std::min(best_, cost(parents, features_));
    } else {
      climb(target, targets_[target], parents);
    }
  }

  /// Every way from a kernel up to the integral image.
  void climb(size_t target, const SparseKernel& kernel, const Parents& parents) {
    if (kernel == SparseKernel::one()) return choose(target + 1, parents);
    std::vector<SparseKernel> above(divisors_[target].begin(), divisors_[target].end());
    above.push_back(SparseKernel::one());
    for (const SparseKernel& parent : above) {
      if (parent == kernel || !kernel.dividedBy(parent)) continue;
      Parents more = parents;
      const auto entry = more.try_emplace(kernel, parent).first;
      if (entry->second == parent) climb(target, parent, more);
    }
  }

  std::int64_t features_;
  std::int64_t best_ = std::numeric_limits<std::int64_t>::max();
  std::vector<SparseKernel> targets_;
  std::vector<std::set<SparseKernel>> divisors_;
};

}  // namespace

std::int64_t fewestAccesses(const haar::FeatureEnsemble& ensemble) {
  return Enumeration(ensemble).fewest();
}

}  // namespace chain_tracker::exhaustive
