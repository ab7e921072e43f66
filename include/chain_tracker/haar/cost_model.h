// SPDX-License-Identifier: BSD-3-Clause
/// Predicts how long plans and corner reads take on this machine.
///
/// A plan is a list of loops over rows; its time is the sum of the times of its loops. The time per
/// element of each different loop (kind of numbers, numbers of taps of each weight, where it reads
/// and writes) is measured once in the life of a model, by itself, on memory of the size that it
/// meets in the plan; no plan is ever run.
#pragma once

#include <memory>

#include <opencv2/core.hpp>

#include "chain_tracker/haar/convolution_plan.h"

namespace chain_tracker::haar {

class CostModel {
 public:
  /// For images and responses of this size. Throws std::invalid_argument for an empty one.
  explicit CostModel(const cv::Size& size);
  ~CostModel();
  CostModel(CostModel&&) noexcept;
  CostModel& operator=(CostModel&&) noexcept;

  /// BufferedExecutor::run() with default options, one thread and one plane, responses stored. The
  /// first plan of its kind takes up to seconds.
  double planSeconds(const ConvolutionPlan& plan);
  /// CornerReads::run() for the plan's ensemble.
  double classicSeconds(const ConvolutionPlan& plan);
  double speedUp(const ConvolutionPlan& plan) { return classicSeconds(plan) / planSeconds(plan); }

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace chain_tracker::haar
