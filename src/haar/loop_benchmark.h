// SPDX-License-Identifier: BSD-3-Clause
/// Times the loops of the front end one by one, each on memory of the size that it meets when plans
/// or corner reads are run.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include <opencv2/core.hpp>

#include "chain_tracker/haar/convolution_plan.h"
#include "row_sums.h"

namespace chain_tracker::haar {

/// Where a loop reads and writes.
enum class Place { kLineBuffer, kImage };

struct MeasuredLoop {
  RowKind kind = RowKind::k32To32;
  SeparableTaps taps;  ///< as in PlanLoop
  Place source = Place::kLineBuffer;
  Place target = Place::kLineBuffer;
  size_t planes = 1;  ///< of the ensemble: targets that are images are written in turn
};

/// Measured when it is called.
struct Measurement {
  std::string name;  ///< the same for loops that take the same time
  std::function<double()> seconds;
};

/// For one size of images. Must outlive its measurements.
class LoopBenchmark {
 public:
  explicit LoopBenchmark(const cv::Size& size);
  ~LoopBenchmark();
  LoopBenchmark(const LoopBenchmark&) = delete;
  LoopBenchmark& operator=(const LoopBenchmark&) = delete;

  /// Per element of the sums.
  Measurement ofLoop(const MeasuredLoop& loop);
  /// Per element of a plan's integral image.
  Measurement ofIntegral(Lane lane);
  /// Of the integral image of corner reads as a whole.
  Measurement ofFullIntegral();

 private:
  class Memory;

  double bufferSeconds(const MeasuredLoop& loop);
  double planeSeconds(const MeasuredLoop& loop);
  double integralSeconds(Lane lane);
  double fullIntegralSeconds() const;
  size_t writtenPlanes(const MeasuredLoop& loop) const;
  std::string nameOf(const std::string& loop) const;
  Memory& memory();

  cv::Size size_;
  std::unique_ptr<Memory> memory_;  ///< allocated when something is measured
};

}  // namespace chain_tracker::haar
