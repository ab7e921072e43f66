// SPDX-License-Identifier: BSD-3-Clause
#include "exact_search.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "forest_paths.h"

namespace chain_tracker::haar {
namespace {

/// Costs that are split among several are rounded down to this fraction of an access.
constexpr std::int64_t kUnit = 5040;
constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max() / 2;
/// Spent on the shifts of one pass of a forest that seems to be the best.
constexpr std::int64_t kShiftWork = 100000000;

/// Depth first over the paths of one junction after the other, the larger kernels first: so all
/// that hangs on a junction is known when its own path is chosen. One search is for forests with
/// exactly `limit_` accesses, of which `root_reads_` are reads of the integral image.
class ExactSearch {
 public:
  ExactSearch(const KernelLattice& lattice, const std::vector<int>& features, std::int64_t max_work)
      : lattice_(lattice),
        features_(features),
        writes_(std::accumulate(features.begin(), features.end(), std::int64_t{0})),
        paths_(lattice, pass_reads_),
        states_(static_cast<size_t>(paths_.size())),
        max_work_(max_work) {
    for (int i = 0; i < paths_.size(); ++i) state(i).is_needed = paths_.isTarget(i);
  }

  ExactResult run(std::int64_t known) {
    for (limit_ = trivialBound(writes_); limit_ < known; ++limit_) {
      for (root_reads_ = 2; writes_ + root_reads_ <= limit_; ++root_reads_) {
        visit(0);
        if (has_ended_) return {limit_, best_};
      }
    }
    return {known, {}};
  }

 private:
  struct State {
    bool is_needed = false;
    const ForestPath* path = nullptr;
    std::vector<int> pass;  ///< what its children read: numbers of PassReads
    int reads = 0;          ///< of the pass, at least
    std::vector<int> children;
  };

  State& state(int junction) { return states_[static_cast<size_t>(junction)]; }

  void visit(int junction) {
    while (junction < paths_.root() && !state(junction).is_needed) ++junction;
    if (junction == paths_.root()) return finish();
    if (work_ + pass_reads_.work() >= max_work_) has_ended_ = true;
    const std::int64_t least = leastToCome(junction);
    if (has_ended_ || kUnit * (accesses() - limit_) + least > 0) return;
    for (const ForestPath& path : paths_.above(junction)) {
      tryPath(junction, path);
      if (has_ended_) return;
    }
  }

  /// Of what is chosen so far.
  std::int64_t accesses() const { return writes_ + root_reads_ + inner_accesses_; }

  void tryPath(int junction, const ForestPath& path) {
    State& above = state(path.above);
    const State before = above;
    const std::int64_t inner_before = inner_accesses_;
    if (attach(junction, path)) visit(junction + 1);
    state(junction).path = nullptr;
    above = before;
    inner_accesses_ = inner_before;
  }

  /// False if that is too much.
  bool attach(int junction, const ForestPath& path) {
    State& above = state(path.above);
    inner_accesses_ += path.tail;
    const int added_to_root = path.above == paths_.root() ? addedToRoot(path.reads) : 0;
    above.pass.push_back(path.reads);
    above.children.push_back(junction);
    state(junction).path = &path;
    if (path.above == paths_.root()) {
      above.reads += added_to_root;
      return accesses() <= limit_ && above.reads <= root_reads_ &&
             pass_reads_.mayFit(above.pass, root_reads_);
    }
    above.is_needed = true;
    const int reads = pass_reads_.least(above.pass);
    inner_accesses_ += reads - above.reads + (above.reads == 0 ? 1 : 0);
    above.reads = reads;
    return accesses() <= limit_;
  }

  /// At least what the paths of the needed junctions from this one on will add, times kUnit. What a
  /// pass over a junction will cost more than now is shared by all that may come to hang on it.
  std::int64_t leastToCome(int junction) {
    const std::vector<int> candidates = countCandidates(junction);
    std::int64_t sum = 0;
    for (int i = junction; i < paths_.root() && sum < kNever; ++i) {
      if (!state(i).is_needed) continue;
      std::int64_t least = kNever;
      for (const ForestPath& path : paths_.above(i)) {
        if (kUnit * path.tail >= least) continue;
        least = std::min(least, kUnit * path.tail +
                                    leastShare(path, candidates[static_cast<size_t>(path.above)]));
      }
      sum += least;
    }
    return sum;
  }

  /// By junction: how many of the needed junctions from this one on may come to hang on it.
  std::vector<int> countCandidates(int junction) {
    std::vector<int> counts(states_.size(), 0);
    for (int i = junction; i < paths_.root(); ++i) {
      if (!state(i).is_needed) continue;
      int last = -1;
      for (const ForestPath& path : paths_.above(i)) {
        if (path.above != last) ++counts[static_cast<size_t>(path.above)];
        last = path.above;
      }
    }
    return counts;
  }

  std::int64_t leastShare(const ForestPath& path, int sharers) {
    const State& above = state(path.above);
    work_ += 1 + static_cast<std::int64_t>(above.pass.size());
    if (path.above == paths_.root()) {
      return above.reads + addedToRoot(path.reads) <= root_reads_ ? 0 : kNever;
    }
    if (above.pass.empty()) return kUnit * (1 + pass_reads_.size(path.reads)) / sharers;
    std::vector<int> pass = above.pass;
    pass.push_back(path.reads);
    return kUnit * (pass_reads_.least(pass) - above.reads) / sharers;
  }

  /// What the pass over the integral image reads more at least if it also reads this, clear at a
  /// glance: all values but those that can be shared with one of the others.
  int addedToRoot(int reads) {
    int added = pass_reads_.size(reads);
    for (const int other : state(paths_.root()).pass) added -= pass_reads_.overlap(reads, other);
    return std::max(0, added);
  }

  /// All paths are chosen.
  void finish() {
    // Fewer accesses have been ruled out before.
    if (accesses() < limit_) return;
    const std::vector<int>& root_pass = state(paths_.root()).pass;
    const UnionAnswer root = unionWithin(supportsOf(root_pass), root_reads_, kShiftWork);
    if (!root.is_possible) return;
    has_ended_ = true;
    if (root.shifts.empty()) return;
    KernelForest forest(lattice_, features_, true);
    attachPass(forest, paths_.root(), root.shifts);
    for (int i = 0; i < paths_.root(); ++i) {
      if (state(i).pass.empty()) continue;
      attachPass(forest, i, alignReads(supportsOf(state(i).pass), kShiftWork).shifts);
    }
    if (forest.cost().accesses == limit_) best_ = std::move(forest);
  }

  std::vector<Support> supportsOf(const std::vector<int>& pass) const {
    std::vector<Support> supports;
    supports.reserve(pass.size());
    for (const int reads : pass) supports.push_back(pass_reads_.support(reads));
    return supports;
  }

  /// The paths that hang on a junction.
  void attachPass(KernelForest& forest, int junction, const std::vector<cv::Point>& shifts) {
    const std::vector<int>& children = state(junction).children;
    for (size_t i = 0; i < children.size(); ++i) {
      int parent = paths_.kernel(junction);
      cv::Point shift = shifts[i];
      for (const int kernel : paths_.kernelsOf(*state(children[i]).path, children[i])) {
        forest.attach(kernel, parent, shift);
        parent = kernel;
        shift = {};
      }
    }
  }

  const KernelLattice& lattice_;
  const std::vector<int>& features_;
  std::int64_t writes_;  ///< of responses
  PassReads pass_reads_;
  ForestPaths paths_;
  std::vector<State> states_;  ///< by junction
  std::int64_t limit_ = 0;
  int root_reads_ = 0;
  std::int64_t inner_accesses_ = 0;  ///< all but writes of responses and reads of the root
  std::int64_t max_work_;
  std::int64_t work_ = 0;  ///< paths that were looked at, each weighted with the pass it would join
  bool has_ended_ = false;
  std::optional<KernelForest> best_;
};

}  // namespace

ExactResult searchExactly(const KernelLattice& lattice, const std::vector<int>& features,
                          std::int64_t known, std::int64_t max_work) {
  return ExactSearch(lattice, features, max_work).run(known);
}

}  // namespace chain_tracker::haar
