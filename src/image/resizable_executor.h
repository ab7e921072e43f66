// SPDX-License-Identifier: BSD-3-Clause
/// A plan of the Haar front end, run on planes whose size changes with every call.
#pragma once

#include <memory>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/haar/buffered_executor.h"
#include "chain_tracker/haar/convolution_plan.h"

namespace chain_tracker {

class ResizableExecutor {
 public:
  /// Throws as haar::ConvolutionPlan does.
  explicit ResizableExecutor(const haar::FeatureEnsemble& ensemble,
                             const haar::PlanOptions& options = {});

  /// The responses of every feature, in planes of the input's size. Allocates only where the input
  /// never was as wide or as high before.
  void run(const cv::Mat1b& input, std::vector<cv::Mat1i>& responses);

 private:
  void resize(const cv::Size& size);

  haar::ConvolutionPlan plan_;
  cv::Size capacity_;
  std::unique_ptr<haar::BufferedExecutor> executor_;
  std::vector<haar::ResponsePlane> outputs_;
};

}  // namespace chain_tracker
