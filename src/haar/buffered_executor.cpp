// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/haar/buffered_executor.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

#include "plan_loops.h"
#include "row_integral.h"
#include "row_rings.h"
#include "row_sums.h"
#include "step_sum.h"
#include "thread_team.h"

namespace chain_tracker::haar {
namespace {

/// Vectors are full: up to so many elements more are computed than needed.
constexpr int kVector = 32;
/// Columns of a strip, unless the caller wants another number.
constexpr int kStripColumns = 2048;

int roundedUp(int value, int step) { return (value + step - 1) / step * step; }
/// Towards minus infinity.
int roundedDown(int value, int step) { return value - ((value % step) + step) % step; }

/// Where responses go.
struct Destination {
  const ResponsePlane* planes = nullptr;  ///< of the features, or null
  ResponseConsumer* consumer = nullptr;   ///< or null
  int plane = 0;
  int streamed_from = 0;  ///< the first feature that is written around the caches
};

/// Computes bands of rows; the memory of one thread.
///
/// Works on blocks: kBatchRows rows, which begin at a multiple of kBatchRows, and a strip of
/// columns. As no step reads below or to the right of where it writes, all steps can follow one
/// another on one block, whose values are then still in the nearest cache.
class BandRunner {
 public:
  BandRunner(const ConvolutionPlan& plan, const cv::Size& capacity, int band_rows,
             const ExecutorOptions& options)
      : plan_(plan),
        instructions_(options.instructions),
        loops_(loopsOf(plan, options.instructions)),
        wanted_columns_(options.strip_columns != 0 ? options.strip_columns : kStripColumns) {
    int margin = 0;
    for (const PlanBuffer& buffer : plan.buffers()) {
      left_ = std::min(left_, buffer.reach.left);
      right_ = std::max(right_, buffer.reach.right);
      top_ = std::min(top_, buffer.reach.top);
      bottom_ = std::max(bottom_, buffer.reach.bottom);
    }
    setSize(capacity);
    for (const PlanLoop& loop : loops_) {
      for (const RowTap& tap : loop.taps.column) margin = std::max(margin, tap.dx);
      for (const RowTap& tap : loop.taps.row) margin = std::max(margin, tap.dx);
    }
    margin = roundedUp(margin + kTouchedColumns, static_cast<int>(kRowAlignment));
    // What one strip hands on, the next one reads.
    const std::vector<size_t> owners = ringOwners(plan, loops_, options.rings && strips() == 1);
    for (size_t i = 0; i < owners.size(); ++i) {
      const PlanBuffer& buffer = plan.buffers()[i];
      ring_of_.push_back(owners[i] == i ? rings_.size() : ring_of_[owners[i]]);
      if (owners[i] != i || !isUsed(i)) continue;
      const int rows = options.rings ? buffer.delays : band_rows + bottom_ - top_;
      rings_.emplace_back(buffer.lane, roundedUp(rows, kBatchRows) + kBatchRows, columns_, margin);
      if (buffer.node == 0) integrals_.push_back(i);
    }
    pixels_.resize(static_cast<size_t>(columns_) * kBatchRows);
    zeros_.resize(static_cast<size_t>(columns_) * sizeof(std::uint32_t));
    before_.resize(integrals_.size() * kBatchRows);
    response_.resize(static_cast<size_t>(columns_) * kBatchRows);
  }

  /// Of the image and the responses: no more than the capacity.
  void setSize(const cv::Size& size) {
    size_ = size;
    columns_ = roundedUp(size.width + right_ - left_, kVector);
    strip_columns_ = roundedUp((columns_ + strips() - 1) / strips(), kVector);
  }

  size_t bytes() const {
    size_t bytes = 0;
    for (const RowRing& ring : rings_) bytes += ring.bytes();
    return bytes;
  }

  void run(const BytePlane& plane, const cv::Range& band, const Destination& destination) noexcept {
    if (band.empty()) return;
    const int first = band.start + top_;
    const int last = band.end + bottom_;
    for (int start = roundedDown(first, kBatchRows); start < last; start += kBatchRows) {
      const cv::Range rows(std::max(first, start), std::min(last, start + kBatchRows));
      std::fill(before_.begin(), before_.end(), 0U);
      for (int column = 0; column < columns_; column += strip_columns_) {
        const cv::Range columns(column, std::min(columns_, column + strip_columns_));
        for (int row = rows.start; row < rows.end; ++row) {
          integrate(pixelsOf(plane, row, columns.start), row, columns, row == first);
        }
        for (const PlanLoop& loop : loops_) {
          runLoop(loop, band, {columns, rows}, destination);
        }
      }
    }
  }

 private:
  /// Columns of the rings and rows.
  struct Block {
    cv::Range columns;
    cv::Range rows;
  };

  bool isUsed(size_t buffer) const {
    return std::any_of(loops_.begin(), loops_.end(), [buffer](const PlanLoop& loop) {
      return static_cast<size_t>(loop.source) == buffer;
    });
  }
  int strips() const { return std::max(1, columns_ / roundedUp(wanted_columns_, kVector)); }
  const PlanBuffer& buffer(int index) const { return plan_.buffers()[static_cast<size_t>(index)]; }
  const RowRing& ring(int index) const { return rings_[ring_of_[static_cast<size_t>(index)]]; }

  /// The next piece of a row of the integral image of the band: whatever lies above and left of it
  /// does not change responses.
  void integrate(const std::uint8_t* pixels, int row, const cv::Range& columns,
                 bool is_first) noexcept {
    for (size_t i = 0; i < integrals_.size(); ++i) {
      const RowRing& integral = rings_[ring_of_[integrals_[i]]];
      const void* above = is_first ? zeros_.data() : integral.at(row - 1, columns.start);
      void* target = integral.at(row, columns.start);
      std::uint32_t& before = before_[i * kBatchRows + static_cast<size_t>(row & (kBatchRows - 1))];
      if (plan_.buffers()[integrals_[i]].lane == Lane::k32) {
        before = integrateRow(pixels, static_cast<const std::uint32_t*>(above), before,
                              static_cast<std::uint32_t*>(target), columns.size(), instructions_);
      } else {
        before = integrateRow(pixels, static_cast<const std::uint16_t*>(above),
                              static_cast<std::uint16_t>(before),
                              static_cast<std::uint16_t*>(target), columns.size(), instructions_);
      }
    }
  }

  /// The pixels of a row from a column of the rings on; zeros outside the image.
  const std::uint8_t* pixelsOf(const BytePlane& plane, int row, int column) noexcept {
    const bool inside = row >= 0 && row < size_.height;
    const std::uint8_t* source = plane.data + row * plane.stride;
    if (inside && left_ + column >= 0 && left_ + columns_ <= size_.width) {
      return source + left_ + column;
    }
    std::uint8_t* pixels =
        pixels_.data() + static_cast<ptrdiff_t>(row & (kBatchRows - 1)) * columns_;
    if (column == 0 && inside) {
      std::uint8_t* const first = pixels - left_;
      std::fill(pixels, first, std::uint8_t{0});
      std::memcpy(first, source, static_cast<size_t>(size_.width));
      std::fill(first + size_.width, pixels + columns_, std::uint8_t{0});
    } else if (column == 0) {
      std::fill(pixels, pixels + columns_, std::uint8_t{0});
    }
    return pixels + column;
  }

  void runLoop(const PlanLoop& loop, const cv::Range& band, const Block& block,
               const Destination& destination) noexcept {
    const int top = loop.target >= 0 ? buffer(loop.target).reach.top : loop.advance.y;
    const int bottom = loop.target >= 0 ? buffer(loop.target).reach.bottom : loop.advance.y;
    const cv::Range rows(std::max(block.rows.start, band.start + top),
                         std::min(block.rows.end, band.end + bottom));
    if (rows.start >= rows.end) return;
    if (loop.target >= 0) {
      writeBuffer(loop, {block.columns, rows});
    } else {
      writeResponse(loop, {block.columns, rows}, destination);
    }
  }

  void writeBuffer(const PlanLoop& loop, const Block& block) noexcept {
    const RowRing& target = ring(loop.target);
    const Reach& reach = buffer(loop.target).reach;
    const int first = std::max(block.columns.start, roundedDown(reach.left - left_, kVector));
    const int end =
        std::min(block.columns.end, roundedUp(size_.width + reach.right - left_, kVector));
    if (first >= end) return;
    loop.sum.run(ring(loop.source).store(), target.at(block.rows.start, first),
                 {block.rows.start, first, block.rows.size(), end - first, target.stride()});
  }

  /// Responses are written up to a multiple of kVector columns, the last strip's up to the end.
  void writeResponse(const PlanLoop& loop, const Block& block,
                     const Destination& destination) noexcept {
    const int shift = loop.advance.x - left_;
    const int first = std::max(0, roundedDown(block.columns.start - shift, kVector));
    const int end = block.columns.end == columns_
                        ? size_.width
                        : std::min(size_.width, roundedDown(block.columns.end - shift, kVector));
    if (first >= end) return;
    const int image_row = block.rows.start - loop.advance.y;
    RowBlock sums{block.rows.start, first + shift, block.rows.size(), end - first, end - first};
    const RowStore source = ring(loop.source).store();
    if (destination.consumer != nullptr) {
      loop.sum.run(source, response_.data(), sums);
      for (int i = 0; i < sums.rows; ++i) {
        destination.consumer->consume(
            {destination.plane, loop.feature, image_row + i, first, sums.columns,
             response_.data() + static_cast<std::ptrdiff_t>(i) * sums.columns});
      }
      return;
    }
    const ResponsePlane& response = destination.planes[loop.feature];
    sums.target_stride = response.stride;
    std::int32_t* target = response.data + image_row * response.stride + first;
    const bool aligned =
        reinterpret_cast<std::uintptr_t>(target) % kStreamAlignment == 0 &&
        response.stride * static_cast<std::ptrdiff_t>(sizeof(*target)) % kStreamAlignment == 0;
    if (loop.feature >= destination.streamed_from && aligned) {
      loop.sum.runStreaming(source, target, sums);
    } else {
      loop.sum.run(source, target, sums);
    }
  }

  const ConvolutionPlan& plan_;
  cv::Size size_;
  InstructionSet instructions_;
  std::vector<PlanLoop> loops_;
  int left_ = 0;
  int right_ = 0;
  int top_ = 0;
  int bottom_ = 0;
  int columns_ = 0;     ///< of the rings
  int wanted_columns_;  ///< of a strip
  int strip_columns_ = 0;
  std::vector<RowRing> rings_;
  std::vector<size_t> ring_of_;       ///< of the buffers
  std::vector<size_t> integrals_;     ///< buffers of the integral image
  std::vector<std::uint8_t> pixels_;  ///< of the rows of a batch
  std::vector<std::uint8_t> zeros_;
  std::vector<std::uint32_t> before_;  ///< of each integral image and row: sum left of the strip
  std::vector<std::int32_t> response_;
};

std::string textOf(const cv::Size& size) {
  return std::to_string(size.width) + " x " + std::to_string(size.height);
}

void requireUsable(const cv::Size& size, const ExecutorOptions& options) {
  if (size.width < 1 || size.height < 1) throw std::invalid_argument("the image is empty");
  if (options.threads < 1) {
    throw std::invalid_argument("threads is " + std::to_string(options.threads) +
                                ", must be at least 1");
  }
  if (options.strip_columns != 0 && options.strip_columns < kVector) {
    throw std::invalid_argument("strip_columns is " + std::to_string(options.strip_columns) +
                                ", must be 0 or at least " + std::to_string(kVector));
  }
}

}  // namespace

class BufferedExecutor::Implementation {
 public:
  Implementation(const ConvolutionPlan& plan, const cv::Size& capacity,
                 const ExecutorOptions& options)
      : features_(plan.ensemble().size()), capacity_(capacity), size_(capacity), options_(options) {
    requireUsable(capacity, options);
    options_.threads = std::min(options.threads, capacity.height);
    const int band_rows = (capacity.height + options_.threads - 1) / options_.threads;
    for (int i = 0; i < options_.threads; ++i) {
      runners_.emplace_back(plan, capacity, band_rows, options_);
    }
    team_ = std::make_unique<ThreadTeam>(options_.threads, [this](int member) { work(member); });
  }

  void setSize(const cv::Size& size) {
    if (size.width < 1 || size.height < 1 || size.width > capacity_.width ||
        size.height > capacity_.height) {
      throw std::invalid_argument("the size is " + textOf(size) + ", must be from 1 x 1 to " +
                                  textOf(capacity_));
    }
    size_ = size;
    for (BandRunner& runner : runners_) runner.setSize(size);
  }

  const cv::Size& size() const { return size_; }
  size_t features() const { return features_; }
  size_t workspaceBytes() const {
    size_t bytes = 0;
    for (const BandRunner& runner : runners_) bytes += runner.bytes();
    return bytes;
  }

  void run(const BytePlane* planes, int plane_count, const ResponsePlane* responses,
           ResponseConsumer* consumer) noexcept {
    planes_ = planes;
    plane_count_ = plane_count;
    responses_ = responses;
    consumer_ = consumer;
    team_->run();
  }

 private:
  cv::Range bandOf(int member) const {
    const auto boundary = [&](int i) {
      return static_cast<int>(static_cast<std::int64_t>(size_.height) * i / options_.threads);
    };
    return {boundary(member), boundary(member + 1)};
  }

  /// The first feature of a plane whose responses are written around the caches.
  int streamedFrom(int plane) const {
    if (options_.streaming == Streaming::kAlways) return 0;
    if (options_.streaming == Streaming::kNever) return static_cast<int>(features_);
    const size_t before = static_cast<size_t>(plane) * features_;
    const size_t cached = cachedPlanes(size_, features_ * static_cast<size_t>(plane_count_));
    return static_cast<int>(std::min(features_, cached - std::min(cached, before)));
  }

  void work(int member) {
    for (int plane = 0; plane < plane_count_; ++plane) {
      Destination destination;
      if (responses_ != nullptr)
        destination.planes = responses_ + static_cast<size_t>(plane) * features_;
      destination.consumer = consumer_;
      destination.plane = plane;
      destination.streamed_from = streamedFrom(plane);
      runners_[static_cast<size_t>(member)].run(planes_[plane], bandOf(member), destination);
    }
  }

  size_t features_;
  cv::Size capacity_;
  cv::Size size_;
  ExecutorOptions options_;
  std::vector<BandRunner> runners_;
  const BytePlane* planes_ = nullptr;
  int plane_count_ = 0;
  const ResponsePlane* responses_ = nullptr;
  ResponseConsumer* consumer_ = nullptr;
  std::unique_ptr<ThreadTeam> team_;
};

BufferedExecutor::BufferedExecutor(const ConvolutionPlan& plan, const cv::Size& size,
                                   const ExecutorOptions& options)
    : implementation_(std::make_unique<Implementation>(plan, size, options)) {}
BufferedExecutor::~BufferedExecutor() = default;
BufferedExecutor::BufferedExecutor(BufferedExecutor&&) noexcept = default;
BufferedExecutor& BufferedExecutor::operator=(BufferedExecutor&&) noexcept = default;

void BufferedExecutor::setSize(const cv::Size& size) { implementation_->setSize(size); }
const cv::Size& BufferedExecutor::size() const { return implementation_->size(); }
size_t BufferedExecutor::workspaceBytes() const { return implementation_->workspaceBytes(); }

void BufferedExecutor::run(const BytePlane* planes, int plane_count,
                           const ResponsePlane* responses) noexcept {
  implementation_->run(planes, plane_count, responses, nullptr);
}

void BufferedExecutor::run(const BytePlane* planes, int plane_count,
                           ResponseConsumer& consumer) noexcept {
  implementation_->run(planes, plane_count, nullptr, &consumer);
}

void BufferedExecutor::run(const cv::Mat1b& image, std::vector<cv::Mat1i>& responses) {
  run(std::vector<cv::Mat1b>{image}, responses);
}

void BufferedExecutor::run(const std::vector<cv::Mat1b>& planes,
                           std::vector<cv::Mat1i>& responses) {
  std::vector<BytePlane> inputs;
  for (const cv::Mat1b& plane : planes) {
    if (plane.size() != size()) {
      throw std::invalid_argument("the image has " + textOf(plane.size()) +
                                  " pixels, the executor is made for " + textOf(size()));
    }
    inputs.push_back({plane.ptr(), static_cast<std::ptrdiff_t>(plane.step1())});
  }
  responses.resize(planes.size() * implementation_->features());
  std::vector<ResponsePlane> outputs;
  for (cv::Mat1i& response : responses) {
    response.create(size());
    outputs.push_back({response[0], static_cast<std::ptrdiff_t>(response.step1())});
  }
  run(inputs.data(), static_cast<int>(inputs.size()), outputs.data());
}

}  // namespace chain_tracker::haar
