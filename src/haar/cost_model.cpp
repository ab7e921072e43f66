// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/haar/cost_model.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>

#include <opencv2/imgproc.hpp>

#include "row_sums.h"
#include "step_sum.h"

namespace chain_tracker::haar {
namespace {

/// Rows of line buffers that the loops read, as in plans of middling kernels.
constexpr int kSourceRows = 48;
/// Times a measurement is repeated; the fastest counts.
constexpr int kRepetitions = 5;
/// Responses that the loops write, so that they are not in the caches [elements].
constexpr size_t kTargetElements = size_t{8} << 20;

double secondsOf(const std::function<void()>& work) {
  double fastest = std::numeric_limits<double>::max();
  for (int i = 0; i < kRepetitions; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    fastest = std::min(fastest, time.count());
  }
  return fastest;
}

bool isNarrow(RowKind kind) { return kind != RowKind::k32To32; }

}  // namespace

CostModel::CostModel(const cv::Size& size)
    : size_(size),
      sources_(static_cast<size_t>(size.width) * (kSourceRows + kBatchRows)),
      targets_(std::max(kTargetElements,
                        static_cast<size_t>(size.width) * static_cast<size_t>(size.height))) {}

double CostModel::loopSeconds(int kind, const std::vector<std::int32_t>& weights,
                              bool is_response) {
  const auto count = [&](std::int32_t weight) {
    return static_cast<size_t>(std::count(weights.begin(), weights.end(), weight));
  };
  const Loop loop(kind, count(1), count(-1), weights.size() - count(1) - count(-1), is_response);
  const auto known = loops_.find(loop);
  if (known != loops_.end()) return known->second;
  return loops_[loop] = measureLoop(kind, weights, is_response);
}

double CostModel::measureLoop(int kind, const std::vector<std::int32_t>& weights,
                              bool is_response) {
  const auto row_kind = static_cast<RowKind>(kind);
  const RowSum sum(row_kind, weights);
  std::vector<const void*> rows;
  for (size_t k = 0; k < weights.size(); ++k) {
    const size_t element = k * 7 % kSourceRows * static_cast<size_t>(size_.width) + k;
    rows.push_back(reinterpret_cast<const char*>(sources_.data()) +
                   element * (isNarrow(row_kind) ? 2 : 4));
  }
  const size_t block_elements = static_cast<size_t>(size_.width) * kBatchRows;
  const size_t blocks = is_response ? targets_.size() / block_elements : 16;
  const RowBlock block{kBatchRows, size_.width - static_cast<int>(weights.size()) % size_.width,
                       size_.width, size_.width};
  const double seconds = secondsOf([&] {
    for (size_t i = 0; i < blocks; ++i) {
      sum.run(rows.data(), targets_.data() + (is_response ? i * block_elements : 0), block);
    }
  });
  return seconds / static_cast<double>(blocks * block_elements);
}

double CostModel::integralSeconds(Lane lane) {
  const std::vector<std::uint8_t> pixels(static_cast<size_t>(size_.width));
  const double seconds = secondsOf([&] {
    for (int row = 0; row < kSourceRows; ++row) {
      std::int32_t* above = sources_.data() + row * size_.width;
      if (lane == Lane::k32) {
        auto* rows = reinterpret_cast<std::uint32_t*>(above);
        integrateRow(pixels.data(), rows, rows + size_.width, size_.width);
      } else {
        auto* rows = reinterpret_cast<std::uint16_t*>(sources_.data()) + row * size_.width;
        integrateRow(pixels.data(), rows, rows + size_.width, size_.width);
      }
    }
  });
  return seconds / (static_cast<double>(size_.width) * kSourceRows);
}

double CostModel::fullIntegralSeconds() {
  const cv::Mat1b image(size_, uchar{1});
  cv::Mat1b padded;
  cv::Mat1i integral;
  return secondsOf([&] {
    cv::copyMakeBorder(image, padded, 8, 8, 8, 8, cv::BORDER_CONSTANT, 0);
    cv::integral(padded, integral, CV_32S);
  });
}

double CostModel::planSeconds(const ConvolutionPlan& plan) {
  double seconds = 0.0;
  const auto elementsOf = [&](const Reach& reach) {
    return static_cast<double>(size_.width + reach.right - reach.left) *
           (size_.height + reach.bottom - reach.top);
  };
  for (const PlanBuffer& buffer : plan.buffers()) {
    if (buffer.node == 0) seconds += integralSeconds(buffer.lane) * elementsOf(buffer.reach);
  }
  for (const PlanStep& step : plan.steps()) {
    const PlanBuffer& source = plan.buffers()[static_cast<size_t>(step.source)];
    const bool is_response = step.target < 0;
    const double elements =
        is_response ? elementsOf({})
                    : elementsOf(plan.buffers()[static_cast<size_t>(step.target)].reach);
    seconds += elements *
               loopSeconds(static_cast<int>(rowKindOf(step, source)), weightsOf(step), is_response);
  }
  return seconds;
}

double CostModel::classicSeconds(const ConvolutionPlan& plan) {
  double seconds = fullIntegralSeconds();
  for (const HaarFeature& feature : plan.ensemble().features()) {
    const SparseKernel kernel = doubleDifference(feature);
    std::vector<std::int32_t> weights;
    for (const KernelTap& tap : kernel.taps()) {
      weights.push_back(static_cast<std::int32_t>(tap.weight));
    }
    seconds += static_cast<double>(size_.area()) *
               loopSeconds(static_cast<int>(RowKind::k32To32), weights, true);
  }
  return seconds;
}

}  // namespace chain_tracker::haar
