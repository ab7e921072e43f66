// SPDX-License-Identifier: BSD-3-Clause
/// From an ensemble to the cheapest ensemble of trees.
///
/// The space. Every kernel is split into factors: 1 - X^n and 1 - Y^n as often as they divide it
/// without leaving more taps, the longest first, then 1 + X^n and 1 + Y^n; what is left stays
/// whole, or is split into its part in X and its part in Y if it separates. Where the ensemble also
/// has the factor 1 - X^m and n = 2m or n = 3m, 1 - X^n is split further into 1 - X^m and the rest;
/// the same in Y. The products of some of a kernel's factors are its divisors. A tree of the space
/// takes every feature's kernel from the integral image through divisors, each dividing the next,
/// in any order of the factors and in any number of passes; a divisor occurs once, so whatever goes
/// through it shares all passes up to it. Edge kernels of one pass may be shifted against one
/// another in any way. Cost: pass_tree.h.
///
/// The search. If there are at most `exact_trees` combinations of chains of divisors, all are
/// looked at, with bounds, each with its best shifts: the tree is then proven to be the best.
/// Otherwise, and as the first bound, a local search: features are taken out of the tree and put
/// back where they cost least, divisors are put in where several kernels gain, and after random
/// disturbances (of a fixed seed) the better tree is kept. Ensembles of more than kMaxSearched
/// different kernels are only aligned. No tree is worse than the classic way.
#pragma once

#include "chain_tracker/haar/haar_feature.h"
#include "chain_tracker/haar/pass_tree.h"

namespace chain_tracker::haar {

struct ParserOptions {
  bool factor = true;               ///< off: kernels stay whole
  bool share_reads = true;          ///< off: every tap of every edge kernel counts as a read
  int search_rounds = 50;           ///< disturbances of the local search, >= 0
  std::int64_t exact_trees = 5000;  ///< 0: no exact search
};

/// Ensembles with more different kernels are not searched but aligned.
constexpr size_t kMaxSearched = 100;

/// Throws std::invalid_argument that names the feature whose rectangles cancel.
PassTree parse(const FeatureEnsemble& ensemble, const ParserOptions& options = {});

/// Every feature in a tree of its own, nothing shared: what the parser makes of each alone.
PassTree parseSeparately(const FeatureEnsemble& ensemble, const ParserOptions& options = {});

/// The kernels of the features, in their order; throws as parse() does.
std::vector<AlignedKernel> alignedKernels(const FeatureEnsemble& ensemble);

}  // namespace chain_tracker::haar
