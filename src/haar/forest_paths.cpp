// SPDX-License-Identifier: BSD-3-Clause
#include "forest_paths.h"

#include <algorithm>
#include <numeric>

namespace chain_tracker::haar {
namespace {

/// Whether a pass that reads one support reads the other, too, at some shift.
bool contains(const Support& support, const Support& other) {
  if (other.size() > support.size()) return false;
  ReadSet reads;
  reads.add(support, {});
  return reads.bestPlacement(other).new_reads == 0;
}

/// Leaves out paths that could be replaced by another at no more cost in every tree.
std::vector<ForestPath> withoutDominated(std::vector<ForestPath> paths, const PassReads& reads) {
  std::stable_sort(paths.begin(), paths.end(), [&](const ForestPath& a, const ForestPath& b) {
    return std::make_pair(a.tail, reads.size(a.reads)) <
           std::make_pair(b.tail, reads.size(b.reads));
  });
  std::vector<ForestPath> kept;
  for (const ForestPath& path : paths) {
    const bool is_dominated = std::any_of(kept.begin(), kept.end(), [&](const ForestPath& other) {
      return contains(reads.support(path.reads), reads.support(other.reads));
    });
    if (!is_dominated) kept.push_back(path);
  }
  return kept;
}

}  // namespace

ForestPaths::ForestPaths(const KernelLattice& lattice, PassReads& reads)
    : lattice_(&lattice),
      by_size_(indexOf(lattice.size())),
      target_uses_(indexOf(lattice.size())),
      tails_(indexOf(lattice.size()), 0),
      next_(indexOf(lattice.size()), 0),
      own_(indexOf(lattice.size())) {
  std::iota(by_size_.begin(), by_size_.end(), 0);
  // The delays of a kernel are those of its divisor and of the quotient added.
  std::stable_sort(by_size_.begin(), by_size_.end(), [&](int a, int b) {
    const cv::Point delay_a = lattice.kernel(a).maxDelay();
    const cv::Point delay_b = lattice.kernel(b).maxDelay();
    return delay_a.x + delay_a.y > delay_b.x + delay_b.y;
  });
  countTargets();
  findTails();
  paths_.resize(junctions_.size());
  for (int junction = 0; junction < root(); ++junction) addPaths(junction, reads);
}

void ForestPaths::countTargets() {
  for (const int target : lattice_->targets()) {
    target_uses_[indexOf(target)].is_target = true;
    for (int kernel = 0; kernel < lattice_->size(); ++kernel) {
      if (kernel != target && lattice_->edge(target, kernel) == nullptr) continue;
      ++target_uses_[indexOf(kernel)].targets;
      target_uses_[indexOf(kernel)].target = target;
    }
  }
}

void ForestPaths::findTails() {
  for (const int kernel : by_size_) {
    const TargetUse& use = target_uses_[indexOf(kernel)];
    if (kernel == 0 || use.is_target || use.targets > 1) {
      junctions_.push_back(kernel);
      continue;
    }
    const auto tail_through = [&](int next) {
      const KernelLattice::Edge* edge = lattice_->edge(next, kernel);
      return 1 + static_cast<int>(edge->support.size()) + tails_[indexOf(next)];
    };
    int& tail = tails_[indexOf(kernel)];
    next_[indexOf(kernel)] = use.target;
    tail = tail_through(use.target);
    for (const int next : own_[indexOf(use.target)]) {
      if (lattice_->edge(next, kernel) == nullptr || tail_through(next) >= tail) continue;
      next_[indexOf(kernel)] = next;
      tail = tail_through(next);
    }
    own_[indexOf(use.target)].push_back(kernel);
  }
}

void ForestPaths::addPaths(int junction, PassReads& reads) {
  std::vector<int> firsts = own_[indexOf(kernel(junction))];
  firsts.push_back(kernel(junction));
  for (int above = junction + 1; above <= root(); ++above) {
    std::vector<ForestPath> paths;
    for (const int first : firsts) {
      const KernelLattice::Edge* edge = lattice_->edge(first, kernel(above));
      if (edge == nullptr) continue;
      paths.push_back({above, first, reads.idOf(edge->support), tails_[indexOf(first)]});
    }
    for (const ForestPath& path : withoutDominated(std::move(paths), reads)) {
      paths_[static_cast<size_t>(junction)].push_back(path);
    }
  }
}

std::vector<int> ForestPaths::kernelsOf(const ForestPath& path, int junction) const {
  std::vector<int> kernels = {path.first};
  while (kernels.back() != kernel(junction)) kernels.push_back(next_[indexOf(kernels.back())]);
  return kernels;
}

}  // namespace chain_tracker::haar
