// SPDX-License-Identifier: BSD-3-Clause
#include "forest_search.h"

#include <algorithm>
#include <numeric>
#include <random>

namespace chain_tracker::haar {
namespace {

/// Features taken out by one disturbance, at most.
constexpr size_t kMaxDisturbed = 4;

class LocalSearch {
 public:
  LocalSearch(const KernelLattice& lattice, const KernelForest& start)
      : lattice_(lattice), best_(start) {}

  KernelForest run(int rounds) {
    improve(best_);
    for (int round = 0; round < rounds; ++round) {
      KernelForest forest = best_;
      disturb(forest);
      if (round % 8 == 0) {
        improve(forest);
      } else {
        reinsertAll(forest);
      }
      if (!(best_.cost() < forest.cost())) best_ = std::move(forest);
    }
    best_.realign();
    return best_;
  }

 private:
  /// A way to put a kernel into the forest: under a parent, or under a new divisor under a parent.
  struct Option {
    int divisor = KernelForest::kAbsent;
    int parent = 0;
    cv::Point shift;  ///< of the divisor, or of the kernel
    ForestCost added;
  };

  std::uint32_t tieBreaker() { return static_cast<std::uint32_t>(random_()); }

  /// Best place for a kernel under the nodes there are.
  Option bestParent(int kernel, const KernelForest& forest) {
    Option best;
    bool found = false;
    const auto consider = [&](int parent) {
      if (kernel == parent) return;
      const KernelForest::Placement place = forest.placement(kernel, parent, tieBreaker());
      if (!place.possible || (found && !(place.added < best.added))) return;
      best = {KernelForest::kAbsent, parent, place.shift, place.added};
      found = true;
    };
    consider(0);
    for (const int node : forest.nodes()) consider(node);
    return best;
  }

  Option bestOption(size_t target, const KernelForest& forest) {
    const int kernel = lattice_.targets()[target];
    Option best = bestParent(kernel, forest);
    for (const int divisor : lattice_.divisors(target)) {
      if (forest.contains(divisor)) continue;
      const KernelLattice::Edge* edge = lattice_.edge(kernel, divisor);
      const auto taps = static_cast<std::int64_t>(edge->support.size());
      const ForestCost last{taps + 1, taps, edge->ring_rows};
      if (last.accesses > best.added.accesses) continue;
      Option option = bestParent(divisor, forest);
      option.divisor = divisor;
      option.added.accesses += last.accesses;
      option.added.taps += last.taps;
      option.added.ring_rows += last.ring_rows;
      if (option.added < best.added) best = option;
    }
    return best;
  }

  void insert(size_t target, KernelForest& forest) {
    const int kernel = lattice_.targets()[target];
    const Option option = bestOption(target, forest);
    if (option.divisor == KernelForest::kAbsent) {
      forest.attach(kernel, option.parent, option.shift);
    } else {
      forest.attach(option.divisor, option.parent, option.shift);
      forest.attach(kernel, option.divisor, {});
    }
  }

  void reinsert(size_t target, KernelForest& forest) {
    forest.detachWithDeadEnds(lattice_.targets()[target]);
    insert(target, forest);
  }

  std::vector<size_t> shuffledTargets() {
    std::vector<size_t> targets(lattice_.targets().size());
    std::iota(targets.begin(), targets.end(), size_t{0});
    std::shuffle(targets.begin(), targets.end(), random_);
    return targets;
  }

  void reinsertAll(KernelForest& forest) {
    for (const size_t target : shuffledTargets()) reinsert(target, forest);
  }

  /// Moves kernels under a new divisor as long as each gains; keeps it if all together gain.
  bool shareDivisor(int divisor, KernelForest& forest) {
    KernelForest changed = forest;
    const Option place = bestParent(divisor, changed);
    changed.attach(divisor, place.parent, place.shift);
    for (const int node : forest.nodes()) {
      if (lattice_.edge(node, divisor) == nullptr || !changed.contains(node)) continue;
      KernelForest moved = changed;
      moved.detach(node);
      const KernelForest::Placement under = moved.placement(node, divisor, tieBreaker());
      moved.attach(node, divisor, under.shift);
      // The write of the divisor is paid once, by all that gain from it.
      const bool is_first = under.added.accesses > 0 && changed.parent(divisor) >= 0;
      const std::int64_t allowance = is_first ? 1 : 0;
      if (moved.cost().accesses <= changed.cost().accesses + allowance) changed = std::move(moved);
    }
    if (!(changed.cost() < forest.cost())) return false;
    forest = std::move(changed);
    return true;
  }

  void improve(KernelForest& forest) {
    std::vector<int> shared;
    for (int kernel = 1; kernel < lattice_.size(); ++kernel) {
      int uses = 0;
      for (const int target : lattice_.targets()) {
        uses += lattice_.edge(target, kernel) != nullptr ? 1 : 0;
      }
      if (uses >= 2) shared.push_back(kernel);
    }
    for (bool changed = true; changed;) {
      const ForestCost before = forest.cost();
      reinsertAll(forest);
      for (const int divisor : shared) {
        if (!forest.contains(divisor)) shareDivisor(divisor, forest);
      }
      changed = forest.cost() < before;
    }
  }

  void disturb(KernelForest& forest) {
    std::vector<size_t> targets = shuffledTargets();
    targets.resize(std::min(targets.size(), 1 + random_() % kMaxDisturbed));
    for (const size_t target : targets) {
      forest.detachWithDeadEnds(lattice_.targets()[target]);
    }
    for (const size_t target : targets) insert(target, forest);
  }

  const KernelLattice& lattice_;
  KernelForest best_;
  std::mt19937 random_{1};
};

}  // namespace

KernelForest directForest(const KernelLattice& lattice, const std::vector<int>& features,
                          const std::vector<cv::Point>& positions, bool share_reads) {
  KernelForest positioned(lattice, features, share_reads);
  KernelForest aligned(lattice, features, share_reads);
  std::vector<size_t> order(lattice.targets().size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return lattice.kernel(lattice.targets()[a]).size() >
           lattice.kernel(lattice.targets()[b]).size();
  });
  for (const size_t i : order) {
    const int target = lattice.targets()[i];
    positioned.attach(target, 0, positions[i]);
    aligned.attach(target, 0, aligned.placement(target, 0, 0).shift);
  }
  return aligned.cost() < positioned.cost() ? aligned : positioned;
}

KernelForest searchForest(const KernelLattice& lattice, const KernelForest& start, int rounds) {
  return LocalSearch(lattice, start).run(rounds);
}

}  // namespace chain_tracker::haar
