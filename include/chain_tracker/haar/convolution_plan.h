// SPDX-License-Identifier: BSD-3-Clause
/// The compiled form of an ensemble: which rows are combined into which, in what arithmetic.
///
/// Arithmetic. Sums are taken modulo 2^16 or 2^32, whichever is the narrowest that determines the
/// response: integral images may wrap around, because a response whose range, proven from the sums
/// of its positive and of its negative weights, fits in 16 (32) bits is determined by its residue.
/// A feature whose range does not fit in 32 bits is refused. A 16-bit row feeds 32-bit sums only
/// if its own range is proven to fit.
///
/// Order of rows. All delays are >= 0, so when row r of the integral image is there, row r of every
/// buffer and then of every response (its advance later) can be computed: each buffer keeps its
/// last `ring_rows` rows.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "chain_tracker/haar/double_difference.h"
#include "chain_tracker/haar/haar_feature.h"
#include "chain_tracker/haar/pass_tree.h"

namespace chain_tracker::haar {

struct PlanOptions {
  bool factor = true;      ///< off: every kernel is read from the integral image directly
  bool share = true;       ///< off: every feature has a tree of its own, and reads are not shared
  bool narrow = true;      ///< off: all sums are taken modulo 2^32, no pass is added for 16 bits
  int max_pixel = 255;     ///< the largest value that a pixel takes, in [1, 255]; 1 for masks
  int search_rounds = 50;  ///< of the parser's local search, >= 0; see parser.h
  std::int64_t exact_work = 10000000;  ///< of the parser's exact search, >= 0
};

enum class Lane { k16, k32 };

/// Columns and rows needed around a region of responses: for columns [a, b) of the responses, the
/// columns [a + left, b + right), and the same of rows.
struct Reach {
  int left = 0;
  int right = 0;
  int top = 0;
  int bottom = 0;
};

/// Rows of intermediate values.
struct PlanBuffer {
  int node = 0;  ///< of the tree; 0: the integral image
  Lane lane = Lane::k32;
  bool is_signed = true;  ///< how 16-bit values are read by 32-bit sums
  int delays = 0;         ///< rows before the current one that are read
  Reach reach;
};

struct PlanInput {
  int dx = 0;
  int dy = 0;
  std::int32_t weight = 0;
};

/// row(x, r) = sum of weight * source(x - dx, r - dy); becomes a row of a buffer, or row
/// r - advance.y, from column x - advance.x, of a response.
struct PlanStep {
  int source = 0;         ///< buffer
  int target = -1;        ///< buffer, or -1
  int feature = -1;       ///< of the ensemble, or -1
  Lane lane = Lane::k32;  ///< modulus of the sum
  bool is_signed = true;  ///< how a 16-bit sum becomes a response
  cv::Point advance;
  std::vector<PlanInput> inputs;
};

class ConvolutionPlan {
 public:
  /// Parses the ensemble. Throws std::invalid_argument that names the feature whose response could
  /// overflow 32 bits, or whose rectangles cancel.
  explicit ConvolutionPlan(const FeatureEnsemble& ensemble, const PlanOptions& options = {});
  /// The same with a tree from elsewhere, which must compute the ensemble.
  ConvolutionPlan(FeatureEnsemble ensemble, PassTree tree, const PlanOptions& options);

  const FeatureEnsemble& ensemble() const { return ensemble_; }
  const PlanOptions& options() const { return options_; }
  const PassTree& tree() const { return tree_; }
  /// Buffers that hold the integral image come first.
  const std::vector<PlanBuffer>& buffers() const { return buffers_; }
  /// In the order in which they run for every row.
  const std::vector<PlanStep>& steps() const { return steps_; }
  /// Proven range of each response.
  const std::vector<ValueRange>& ranges() const { return ranges_; }
  /// Rows that must be known below the row of a response.
  int lookahead() const;

  /// Memory accesses per pixel of the classic way and of the parser's tree.
  std::int64_t classicAccesses() const { return classic_accesses_; }
  std::int64_t parsedAccesses() const { return parsed_accesses_; }
  /// Those of tree(): some more than the parser's, but of 16 bits instead of 32, where that moves
  /// fewer bytes.
  std::int64_t accesses() const { return tree_.accesses(); }

  /// The trees, with accesses, borders, ring sizes and ranges, as text for people.
  std::string describe() const;
  /// The trees in the language of Graphviz.
  std::string dot() const;

 private:
  void proveRanges();
  void makeSteps();
  int addBuffer(int node, Lane lane, bool is_signed);
  void addResponse(int source, const SparseKernel& edge, Lane lane, int feature);
  void measureReach();

  FeatureEnsemble ensemble_;
  PlanOptions options_;
  PassTree tree_;
  std::vector<PlanBuffer> buffers_;
  std::vector<PlanStep> steps_;
  std::vector<ValueRange> ranges_;
  std::int64_t classic_accesses_ = 0;
  std::int64_t parsed_accesses_ = 0;
};

}  // namespace chain_tracker::haar
