// SPDX-License-Identifier: BSD-3-Clause
/// Predicts how long plans and corner reads take on this machine.
///
/// A plan is a list of loops over rows; its time is the sum of the times of its loops. The time per
/// element of each different loop (kind of numbers, numbers of taps of each weight, where it reads
/// and writes) is measured once per machine and size of images, by itself, on memory of the size
/// that it meets in the plan; no plan is ever run. A file keeps the measurements; another
/// processor, or another build of the loops, measures anew.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include <opencv2/core.hpp>

#include "chain_tracker/haar/convolution_plan.h"

namespace chain_tracker::haar {

/// $XDG_CACHE_HOME/chain_tracker/haar_timings.yaml, in ~/.cache if that variable is not set; empty
/// without a home.
std::string costModelFile();

struct CostModelOptions {
  /// Keeps the measurements; empty: they end with the model. A file that cannot be read or written
  /// is no error: it is as if there were none.
  std::string file = costModelFile();
  bool measure_anew = false;  ///< replaces all that the file keeps
};

class CostModel {
 public:
  /// For images and responses of this size. Throws std::invalid_argument for an empty one.
  explicit CostModel(const cv::Size& size, const CostModelOptions& options = {});
  ~CostModel();
  CostModel(CostModel&&) noexcept;
  CostModel& operator=(CostModel&&) noexcept;

  /// BufferedExecutor::run() with default options, one thread and one plane, responses stored.
  /// Loops that have not been measured are: the first plan of its kind takes some ten seconds.
  double planSeconds(const ConvolutionPlan& plan);
  /// CornerReads::run() for the plan's ensemble.
  double classicSeconds(const ConvolutionPlan& plan);
  double speedUp(const ConvolutionPlan& plan);

  /// How many different loops this model has measured: those that the file did not tell.
  size_t measuredLoops() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace chain_tracker::haar
