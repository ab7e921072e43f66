// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/haar/convolution_plan.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "chain_tracker/haar/parser.h"
#include "narrowing.h"

namespace chain_tracker::haar {
namespace {

constexpr std::int64_t kLeast16 = std::numeric_limits<std::int16_t>::min();
constexpr std::int64_t kLargest16 = std::numeric_limits<std::int16_t>::max();
constexpr std::int64_t kLeast32 = std::numeric_limits<std::int32_t>::min();
constexpr std::int64_t kLargest32 = std::numeric_limits<std::int32_t>::max();

bool fitsSigned16(const ValueRange& range) { return range.within(kLeast16, kLargest16); }

PassTree treeOf(const FeatureEnsemble& ensemble, const PlanOptions& options) {
  ParserOptions parser;
  parser.factor = options.factor;
  parser.search_rounds = options.search_rounds;
  parser.exact_work = options.exact_work;
  return options.share ? parse(ensemble, parser) : parseSeparately(ensemble, parser);
}

/// Which features each node is.
std::vector<std::vector<int>> featuresOfNodes(const PassTree& tree) {
  std::vector<std::vector<int>> features(tree.nodes.size());
  for (size_t i = 0; i < tree.features.size(); ++i) {
    features[static_cast<size_t>(tree.features[i].node)].push_back(static_cast<int>(i));
  }
  return features;
}

std::vector<bool> nodesWithChildren(const PassTree& tree) {
  std::vector<bool> parents(tree.nodes.size(), false);
  for (const PassNode& node : tree.nodes) {
    if (node.parent >= 0) parents[static_cast<size_t>(node.parent)] = true;
  }
  return parents;
}

/// Chooses the modulus of every node but the integral image, which may exist in both.
class LaneChoice {
 public:
  LaneChoice(const PassTree& tree, const std::vector<ValueRange>& ranges,
             const PlanOptions& options)
      : tree_(tree), lanes_(tree.nodes.size(), options.narrow ? Lane::k16 : Lane::k32) {
    for (const PassNode& node : tree.nodes) {
      node_ranges_.push_back(rangeOnImage(node.kernel, options.max_pixel));
    }
    for (size_t i = 0; i < ranges.size(); ++i) {
      if (!fits16(ranges[i])) widen(static_cast<size_t>(tree.features[i].node));
    }
    while (widenOnce()) continue;
  }

  Lane lane(size_t node) const { return lanes_[node]; }
  bool isExact16(size_t node) const {
    return lanes_[node] == Lane::k16 && node_ranges_[node] && fits16(*node_ranges_[node]);
  }
  bool isSigned(size_t node) const {
    return !node_ranges_[node] || fitsSigned16(*node_ranges_[node]);
  }

 private:
  void widen(size_t node) { lanes_[node] = Lane::k32; }

  /// A 32-bit sum needs sources that are exact or modulo 2^32; a 16-bit sum needs 16-bit sources.
  bool widenOnce() {
    bool changed = false;
    for (size_t i = 1; i < tree_.nodes.size(); ++i) {
      const auto parent = static_cast<size_t>(tree_.nodes[i].parent);
      if (parent == 0) continue;
      if (lanes_[i] == Lane::k32 && lanes_[parent] == Lane::k16 && !isExact16(parent)) {
        widen(parent);
        changed = true;
      } else if (lanes_[i] == Lane::k16 && lanes_[parent] == Lane::k32) {
        widen(i);
        changed = true;
      }
    }
    return changed;
  }

  const PassTree& tree_;
  std::vector<Lane> lanes_;
  std::vector<std::optional<ValueRange>> node_ranges_;
};

std::vector<PlanInput> inputsOf(const SparseKernel& edge, std::int64_t scale) {
  std::vector<PlanInput> inputs;
  for (const KernelTap& tap : edge.taps()) {
    // Modulo 2^32, as all sums are; the response is proven to fit.
    const auto weight = static_cast<std::uint32_t>(tap.weight * scale);
    inputs.push_back({tap.dx, tap.dy, static_cast<std::int32_t>(weight)});
  }
  return inputs;
}

Reach unionOf(const Reach& a, const Reach& b) {
  return {std::min(a.left, b.left), std::max(a.right, b.right), std::min(a.top, b.top),
          std::max(a.bottom, b.bottom)};
}

/// What a step needs of its source, given where its own values are needed.
Reach reachOfInputs(const PlanStep& step, const Reach& reach) {
  Reach result;
  for (size_t i = 0; i < step.inputs.size(); ++i) {
    const PlanInput& input = step.inputs[i];
    const Reach shifted{reach.left - input.dx, reach.right - input.dx, reach.top - input.dy,
                        reach.bottom - input.dy};
    result = i == 0 ? shifted : unionOf(result, shifted);
  }
  return result;
}

}  // namespace

ConvolutionPlan::ConvolutionPlan(const FeatureEnsemble& ensemble, const PlanOptions& options)
    : ConvolutionPlan(ensemble, treeOf(ensemble, options), options) {}

ConvolutionPlan::ConvolutionPlan(FeatureEnsemble ensemble, PassTree tree,
                                 const PlanOptions& options)
    : ensemble_(std::move(ensemble)),
      options_(options),
      tree_(std::move(tree)),
      classic_accesses_(haar::classicAccesses(ensemble_)),
      parsed_accesses_(tree_.accesses()) {
  proveRanges();
  if (options_.narrow && options_.factor && ensemble_.size() <= kMaxSearched) {
    tree_ = narrowedTree(tree_, ranges_, options_.max_pixel);
  }
  makeSteps();
  measureReach();
}

void ConvolutionPlan::proveRanges() {
  if (options_.max_pixel < 1 || options_.max_pixel > 255) {
    throw std::invalid_argument("max_pixel is " + std::to_string(options_.max_pixel) +
                                ", must be in [1, 255]");
  }
  for (const HaarFeature& feature : ensemble_.features()) {
    const ValueRange range = rangeOnImage(doubleDifference(feature), options_.max_pixel).value();
    if (!range.within(kLeast32, kLargest32)) {
      throw std::invalid_argument("ensemble '" + ensemble_.name() + "': feature '" + feature.name +
                                  "': the response lies in [" + std::to_string(range.low) + ", " +
                                  std::to_string(range.high) + "] and could overflow 32 bits");
    }
    ranges_.push_back(range);
  }
}

int ConvolutionPlan::addBuffer(int node, Lane lane, bool is_signed) {
  PlanBuffer buffer;
  buffer.node = node;
  buffer.lane = lane;
  buffer.is_signed = is_signed;
  buffers_.push_back(buffer);
  return static_cast<int>(buffers_.size()) - 1;
}

void ConvolutionPlan::addResponse(int source, const SparseKernel& edge, Lane lane, int feature) {
  const FeatureNode& node = tree_.features[static_cast<size_t>(feature)];
  PlanStep step;
  step.source = source;
  step.feature = feature;
  step.lane = lane;
  step.is_signed = fitsSigned16(ranges_[static_cast<size_t>(feature)]);
  step.advance = -node.delay;
  step.inputs = inputsOf(edge, node.scale);
  steps_.push_back(std::move(step));
}

void ConvolutionPlan::makeSteps() {
  const LaneChoice lanes(tree_, ranges_, options_);
  const std::vector<std::vector<int>> features = featuresOfNodes(tree_);
  const std::vector<bool> is_parent = nodesWithChildren(tree_);
  std::vector<int> buffer_of(tree_.nodes.size(), -1);
  int integral[2] = {-1, -1};  // by lane
  for (const Lane lane : {Lane::k32, Lane::k16}) {
    for (size_t i = 1; i < tree_.nodes.size(); ++i) {
      int& buffer = integral[static_cast<size_t>(lane)];
      if (tree_.nodes[i].parent == 0 && lanes.lane(i) == lane && buffer < 0) {
        buffer = addBuffer(0, lane, lanes.isSigned(0));
      }
    }
  }
  for (size_t i = 1; i < tree_.nodes.size(); ++i) {
    const PassNode& node = tree_.nodes[i];
    const int source = node.parent == 0 ? integral[static_cast<size_t>(lanes.lane(i))]
                                        : buffer_of[static_cast<size_t>(node.parent)];
    if (!is_parent[i] && features[i].size() == 1) {
      addResponse(source, node.edge, lanes.lane(i), features[i].front());
      continue;
    }
    buffer_of[i] = addBuffer(static_cast<int>(i), lanes.lane(i), lanes.isSigned(i));
    PlanStep step;
    step.source = source;
    step.target = buffer_of[i];
    step.lane = lanes.lane(i);
    step.inputs = inputsOf(node.edge, 1);
    steps_.push_back(std::move(step));
    for (const int feature : features[i]) {
      addResponse(buffer_of[i], SparseKernel::one(), lanes.lane(i), feature);
    }
  }
}

void ConvolutionPlan::measureReach() {
  std::vector<bool> is_reached(buffers_.size(), false);
  for (auto step = steps_.rbegin(); step != steps_.rend(); ++step) {
    const Reach own = step->target >= 0 ? buffers_[static_cast<size_t>(step->target)].reach
                                        : Reach{step->advance.x, step->advance.x, step->advance.y,
                                                step->advance.y};
    const auto source = static_cast<size_t>(step->source);
    PlanBuffer& buffer = buffers_[source];
    const Reach needed = reachOfInputs(*step, own);
    buffer.reach = is_reached[source] ? unionOf(buffer.reach, needed) : needed;
    is_reached[source] = true;
    for (const PlanInput& input : step->inputs) {
      buffer.delays = std::max(buffer.delays, input.dy);
    }
  }
}

int ConvolutionPlan::lookahead() const {
  int rows = 0;
  for (const PlanStep& step : steps_) rows = std::max(rows, step.advance.y);
  return rows;
}

}  // namespace chain_tracker::haar
