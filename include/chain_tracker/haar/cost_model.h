// SPDX-License-Identifier: BSD-3-Clause
/// Predicts how long plans and corner reads take on this machine.
///
/// A plan is a list of loops over blocks of rows; its time is the sum of the times of its loops.
/// The time per element of each different loop is measured once in the life of a model, by itself,
/// on memory of the size and order that it meets in the plan; no plan is ever run.
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/haar/convolution_plan.h"

namespace chain_tracker::haar {

class CostModel {
 public:
  /// For images and responses of this size.
  explicit CostModel(const cv::Size& size);

  /// BufferedExecutor::run() with one thread and one plane, responses stored.
  double planSeconds(const ConvolutionPlan& plan);
  /// CornerReads::run() for the plan's ensemble.
  double classicSeconds(const ConvolutionPlan& plan);
  double speedUp(const ConvolutionPlan& plan) { return classicSeconds(plan) / planSeconds(plan); }

 private:
  /// Kind of row, numbers of weights 1, -1 and others, and where the target is.
  using Loop = std::tuple<int, size_t, size_t, size_t, bool>;

  double loopSeconds(int kind, const std::vector<std::int32_t>& weights, bool is_response);
  double measureLoop(int kind, const std::vector<std::int32_t>& weights, bool is_response);
  double integralSeconds(Lane lane);
  double fullIntegralSeconds();

  cv::Size size_;
  std::map<Loop, double> loops_;  ///< seconds per element
  std::vector<std::int32_t> sources_;
  std::vector<std::int32_t> targets_;
};

}  // namespace chain_tracker::haar
