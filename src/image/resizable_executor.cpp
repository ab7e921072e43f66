// SPDX-License-Identifier: BSD-3-Clause
#include "resizable_executor.h"

#include <algorithm>
#include <cstddef>

#include "reused_plane.h"

namespace chain_tracker {
namespace {

/// Executors are made for sizes that are multiples of this, so that few are made.
constexpr int kCapacityStep = 32;

int roundedUp(int value) { return (value + kCapacityStep - 1) / kCapacityStep * kCapacityStep; }

}  // namespace

ResizableExecutor::ResizableExecutor(const haar::FeatureEnsemble& ensemble,
                                     const haar::PlanOptions& options)
    : plan_(ensemble, options), outputs_(ensemble.size()) {}

void ResizableExecutor::resize(const cv::Size& size) {
  if (size.width > capacity_.width || size.height > capacity_.height) {
    capacity_ = {roundedUp(std::max(size.width, capacity_.width)),
                 roundedUp(std::max(size.height, capacity_.height))};
    executor_ = std::make_unique<haar::BufferedExecutor>(plan_, capacity_);
  }
  executor_->setSize(size);
}

void ResizableExecutor::run(const cv::Mat1b& input, std::vector<cv::Mat1i>& responses) {
  resize(input.size());
  responses.resize(outputs_.size());
  for (size_t i = 0; i < outputs_.size(); ++i) {
    reuse(responses[i], input.size());
    outputs_[i] = {responses[i][0], static_cast<std::ptrdiff_t>(responses[i].step1())};
  }
  const haar::BytePlane plane{input.ptr(), static_cast<std::ptrdiff_t>(input.step1())};
  executor_->run(&plane, 1, outputs_.data());
}

}  // namespace chain_tracker
