// SPDX-License-Identifier: BSD-3-Clause
/// From an ensemble to the cheapest ensemble of trees.
///
/// The space. Every kernel is split into factors: 1 - X^n and 1 - Y^n as often as they divide it
/// without leaving more taps, the longest first, then 1 + X^n and 1 + Y^n; what is left stays
/// whole, or is split into its part in X and its part in Y if it separates. Where the ensemble also
/// has the factor 1 - X^m and n = 2m or n = 3m, 1 - X^n is split further into 1 - X^m and the rest;
/// the same in Y. The products of some of a kernel's factors that have no more taps than the
/// kernel, and leave no more, are its divisors. A tree of the space is made of the kernels of all
/// features and of their divisors: each of its kernels is computed in one pass from any other of
/// them that divides it, or from the integral image; so whatever goes through a kernel shares all
/// passes up to it. Edge kernels of one pass may be shifted against one another in any way. Cost:
/// pass_tree.h.
///
/// The search. First a local one: features are taken out of the tree and put back where they cost
/// least, divisors are put in where several kernels gain, and after random disturbances (of a fixed
/// seed) the better tree is kept. Then an exact one, for trees with the fewest accesses that there
/// could be, then for trees with one more, and so on. If that comes as far as the tree found, this
/// is proven to be the best, or a better one was found that is; if its work is done before, as far
/// as it came is what every tree of the space needs at least. Ensembles of more than kMaxSearched
/// different kernels are only aligned. No tree is worse than the classic way.
#pragma once

#include "chain_tracker/haar/haar_feature.h"
#include "chain_tracker/haar/pass_tree.h"

namespace chain_tracker::haar {

struct ParserOptions {
  bool factor = true;                  ///< off: kernels stay whole
  bool share_reads = true;             ///< off: every tap of every edge kernel counts as a read
  int search_rounds = 50;              ///< disturbances of the local search, >= 0
  std::int64_t exact_work = 10000000;  ///< of the exact search, about a second; 0: none
};

/// Ensembles with more different kernels are not searched but aligned.
constexpr size_t kMaxSearched = 100;
/// There is no exact search where features and divisors are more different kernels than this.
constexpr int kMaxExact = 1000;

/// Throws std::invalid_argument that names the feature whose rectangles cancel.
PassTree parse(const FeatureEnsemble& ensemble, const ParserOptions& options = {});

/// Every feature in a tree of its own, nothing shared: what the parser makes of each alone.
PassTree parseSeparately(const FeatureEnsemble& ensemble, const ParserOptions& options = {});

/// The kernels of the features, in their order; throws as parse() does.
std::vector<AlignedKernel> alignedKernels(const FeatureEnsemble& ensemble);

}  // namespace chain_tracker::haar
