// SPDX-License-Identifier: BSD-3-Clause
/// Runs a plan row by row: no intermediate image is ever stored, only the last rows of each buffer
/// in rings. The integral image is summed up in the same loop.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/haar/convolution_plan.h"
#include "chain_tracker/haar/instruction_set.h"

namespace chain_tracker::haar {

/// Rows of bytes: element (x, y) is data[y * stride + x].
struct BytePlane {
  const std::uint8_t* data = nullptr;
  std::ptrdiff_t stride = 0;
};

/// Rows of responses: element (x, y) is data[y * stride + x].
struct ResponsePlane {
  std::int32_t* data = nullptr;
  std::ptrdiff_t stride = 0;
};

/// A piece of a row of responses that was just computed.
struct ResponseRow {
  int plane = 0;    ///< of the inputs
  int feature = 0;  ///< of the ensemble
  int row = 0;
  int column = 0;  ///< of the first value
  int count = 0;
  const std::int32_t* values = nullptr;  ///< valid during the call only
};

/// Takes responses while they are in the nearest cache. Called by all threads at once, if there
/// are several; every response comes exactly once.
class ResponseConsumer {
 public:
  ResponseConsumer() = default;
  ResponseConsumer(const ResponseConsumer&) = delete;
  ResponseConsumer& operator=(const ResponseConsumer&) = delete;
  virtual ~ResponseConsumer() = default;
  virtual void consume(const ResponseRow& row) noexcept = 0;
};

enum class Streaming {
  kAuto,   ///< responses are written through the caches as far as these can keep them
  kNever,  ///< responses are written through the caches
  kAlways  ///< responses are written around the caches, where the machine and alignment allow
};

struct ExecutorOptions {
  int threads = 1;        ///< >= 1; bands of rows
  bool rings = true;      ///< off: buffers keep all rows
  int strip_columns = 0;  ///< columns worked on at a time, >= 32; 0: chosen from the plan
  Streaming streaming = Streaming::kAuto;
  InstructionSet instructions = InstructionSet::kBest;
};

class BufferedExecutor {
 public:
  /// Allocates everything that run() needs. The plan must outlive the executor.
  /// Throws std::invalid_argument for an empty size or options out of range.
  BufferedExecutor(const ConvolutionPlan& plan, const cv::Size& size,
                   const ExecutorOptions& options = {});
  ~BufferedExecutor();
  BufferedExecutor(BufferedExecutor&&) noexcept;
  BufferedExecutor& operator=(BufferedExecutor&&) noexcept;

  /// Of the images and responses from now on; at first the size that the executor was made for,
  /// never more. Allocates nothing. Throws std::invalid_argument for a size out of range.
  void setSize(const cv::Size& size);
  const cv::Size& size() const;
  /// Memory for intermediate values, all threads together [bytes].
  size_t workspaceBytes() const;

  /// Computes `responses[plane * features + feature]` of every plane; all planes have size().
  /// Allocates nothing and cannot fail. Not to be called by two threads at once.
  void run(const BytePlane* planes, int plane_count, const ResponsePlane* responses) noexcept;
  /// The same, handed over piece by piece instead of stored.
  void run(const BytePlane* planes, int plane_count, ResponseConsumer& consumer) noexcept;

  /// The convenient form: one image of size(), responses allocated where their size is another.
  /// Throws std::invalid_argument if the image has another size.
  void run(const cv::Mat1b& image, std::vector<cv::Mat1i>& responses);
  /// The same for several planes; responses as in run() above.
  void run(const std::vector<cv::Mat1b>& planes, std::vector<cv::Mat1i>& responses);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace chain_tracker::haar
