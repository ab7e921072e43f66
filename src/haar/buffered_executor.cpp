// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/haar/buffered_executor.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

#include "row_sums.h"
#include "step_sum.h"
#include "thread_team.h"

namespace chain_tracker::haar {
namespace {

/// Elements that may be computed beyond the last one needed, so that vectors are full.
constexpr int kSlack = 64;
constexpr int kFullVector = 16;
constexpr size_t kAlignment = 64;
/// Responses larger than this are written around the caches [bytes].
constexpr size_t kStreamedBytes = size_t{24} << 20;
/// Columns of a strip, unless the caller wants another number.
constexpr int kStripColumns = 2048;

int roundedUp(int value, int step) { return (value + step - 1) / step * step; }

/// The part of the responses that one run over the rows computes.
struct Tile {
  cv::Range columns;
  cv::Range rows;
};

/// The last rows of a buffer. All rings of a tile begin at the same column.
class RowRing {
 public:
  RowRing(const PlanBuffer& buffer, int rows, int columns)
      : element_size_(buffer.lane == Lane::k16 ? 2 : 4),
        mask_(rows - 1),
        stride_(static_cast<size_t>(roundedUp(columns + kSlack, kSlack)) * element_size_),
        memory_(stride_ * static_cast<size_t>(rows) + kAlignment) {
    const auto address = reinterpret_cast<std::uintptr_t>(memory_.data());
    first_ = memory_.data() + (kAlignment - address % kAlignment) % kAlignment;
  }

  /// Element `column` of a row; the rings keep as many rows as were asked for.
  void* at(int row, int column) {
    return first_ + static_cast<size_t>(row & mask_) * stride_ +
           static_cast<size_t>(column) * element_size_;
  }
  /// Rows from this one on that lie below one another in memory.
  int rowsFrom(int row) const { return mask_ + 1 - (row & mask_); }
  /// Elements from a row to the next.
  std::ptrdiff_t stride() const { return static_cast<std::ptrdiff_t>(stride_ / element_size_); }
  size_t bytes() const { return memory_.size(); }

 private:
  size_t element_size_;
  int mask_;
  size_t stride_;
  std::vector<std::uint8_t> memory_;
  std::uint8_t* first_;
};

int powerOfTwoFrom(int least) {
  int power = 1;
  while (power < least) power *= 2;
  return power;
}

/// Where responses go.
struct Destination {
  const ResponsePlane* planes = nullptr;  ///< of the features, or null
  ResponseConsumer* consumer = nullptr;   ///< or null
  int plane = 0;
  bool streaming = false;
};

/// Computes tiles; the memory of one thread.
class TileRunner {
 public:
  TileRunner(const ConvolutionPlan& plan, const cv::Size& size, int strip_columns, int band_rows,
             const ExecutorOptions& options)
      : plan_(plan), size_(size) {
    int right = 0;
    int rows = band_rows;
    for (const PlanBuffer& buffer : plan.buffers()) {
      left_ = std::min(left_, buffer.reach.left);
      right = std::max(right, buffer.reach.right);
      top_ = std::min(top_, buffer.reach.top);
      bottom_ = std::max(bottom_, buffer.reach.bottom);
    }
    rows += bottom_ - top_;
    for (const PlanBuffer& buffer : plan.buffers()) {
      rings_.emplace_back(
          buffer, powerOfTwoFrom(options.rings ? buffer.delays + kBatchRows : rows + kBatchRows),
          strip_columns + right - left_);
      if (buffer.node == 0) integrals_.push_back(rings_.size() - 1);
    }
    pixels_.resize(static_cast<size_t>(strip_columns + right - left_ + kSlack));
    zeros_.resize(pixels_.size() * sizeof(std::uint32_t));
    response_.resize(static_cast<size_t>(strip_columns) * kBatchRows);
    size_t inputs = 0;
    for (const PlanStep& step : plan.steps()) {
      inputs = std::max(inputs, step.inputs.size());
      const PlanBuffer& source = plan.buffers()[static_cast<size_t>(step.source)];
      sums_.emplace_back(rowKindOf(step, source), weightsOf(step), options.instructions);
    }
    inputs_.resize(inputs);
  }

  size_t bytes() const {
    size_t bytes = 0;
    for (const RowRing& ring : rings_) bytes += ring.bytes();
    return bytes;
  }

  void run(const BytePlane& plane, const Tile& tile, const Destination& destination) noexcept {
    const int first = tile.rows.start + top_;
    const int last = tile.rows.end + bottom_;
    for (int start = first; start < last; start += kBatchRows) {
      const cv::Range batch(start, std::min(last, start + kBatchRows));
      for (int row = batch.start; row < batch.end; ++row) {
        integrate(plane, tile, row, row == first);
      }
      for (size_t i = 0; i < plan_.steps().size(); ++i) runStep(i, tile, batch, destination);
    }
  }

 private:
  const PlanBuffer& buffer(size_t index) const { return plan_.buffers()[index]; }

  /// Next row of the integral image of the tile: whatever lies above and left of it does not
  /// change responses.
  void integrate(const BytePlane& plane, const Tile& tile, int row, bool is_first) noexcept {
    const std::uint8_t* pixels = pixelsOf(plane, tile, row);
    for (size_t i = 0; i < integrals_.size(); ++i) {
      const size_t index = integrals_[i];
      RowRing& ring = rings_[index];
      const Reach& reach = buffer(index).reach;
      const int begin = reach.left - left_;
      const int count = roundedUp(tile.columns.size() + reach.right - reach.left, kFullVector);
      const void* above = is_first ? zeros_.data() : ring.at(row - 1, begin);
      if (buffer(index).lane == Lane::k32) {
        integrateRow(pixels + begin, static_cast<const std::uint32_t*>(above),
                     static_cast<std::uint32_t*>(ring.at(row, begin)), count);
      } else {
        integrateRow(pixels + begin, static_cast<const std::uint16_t*>(above),
                     static_cast<std::uint16_t*>(ring.at(row, begin)), count);
      }
    }
  }

  /// The pixels of a row from the first column of the rings on; zeros outside the image.
  const std::uint8_t* pixelsOf(const BytePlane& plane, const Tile& tile, int row) noexcept {
    const int origin = tile.columns.start + left_;
    const auto length = static_cast<int>(pixels_.size());
    const bool inside = row >= 0 && row < size_.height;
    const std::uint8_t* source = plane.data + row * plane.stride;
    if (inside && origin >= 0 && origin + length <= size_.width) return source + origin;
    std::fill(pixels_.begin(), pixels_.end(), std::uint8_t{0});
    const int begin = std::max(0, origin);
    const int end = std::min(size_.width, origin + length);
    if (inside && begin < end) {
      std::memcpy(pixels_.data() + (begin - origin), source + begin,
                  static_cast<size_t>(end - begin));
    }
    return pixels_.data();
  }

  void runStep(size_t index, const Tile& tile, const cv::Range& batch,
               const Destination& destination) noexcept {
    const PlanStep& step = plan_.steps()[index];
    cv::Range rows = batch;
    if (step.target >= 0) {
      const Reach& reach = buffer(static_cast<size_t>(step.target)).reach;
      rows.start = std::max(rows.start, tile.rows.start + reach.top);
      rows.end = std::min(rows.end, tile.rows.end + reach.bottom);
    } else {
      rows.start = std::max(rows.start, tile.rows.start + step.advance.y);
      rows.end = std::min(rows.end, tile.rows.end + step.advance.y);
    }
    while (rows.start < rows.end) {
      const int count = std::min(rows.size(), contiguousRows(step, rows.start));
      if (step.target >= 0) {
        writeBuffer(index, tile, rows.start, count);
      } else {
        writeResponse(index, tile, rows.start, count, destination);
      }
      rows.start += count;
    }
  }

  /// Rows that can be summed in one go: until a ring comes round.
  int contiguousRows(const PlanStep& step, int row) const noexcept {
    const RowRing& source = rings_[static_cast<size_t>(step.source)];
    int rows =
        step.target >= 0 ? rings_[static_cast<size_t>(step.target)].rowsFrom(row) : kBatchRows;
    for (const PlanInput& input : step.inputs) {
      rows = std::min(rows, source.rowsFrom(row - input.dy));
    }
    return rows;
  }

  void bindInputs(size_t index, int row, int column) noexcept {
    const PlanStep& step = plan_.steps()[index];
    const std::vector<size_t>& order = sums_[index].order();
    RowRing& source = rings_[static_cast<size_t>(step.source)];
    for (size_t i = 0; i < order.size(); ++i) {
      const PlanInput& input = step.inputs[order[i]];
      inputs_[i] = source.at(row - input.dy, column - input.dx);
    }
  }

  void writeBuffer(size_t index, const Tile& tile, int row, int rows) noexcept {
    const PlanStep& step = plan_.steps()[index];
    const Reach& reach = buffer(static_cast<size_t>(step.target)).reach;
    RowRing& target = rings_[static_cast<size_t>(step.target)];
    const int begin = reach.left - left_;
    const int columns = roundedUp(tile.columns.size() + reach.right - reach.left, kFullVector);
    bindInputs(index, row, begin);
    sums_[index].run(
        inputs_.data(), target.at(row, begin),
        {rows, columns, rings_[static_cast<size_t>(step.source)].stride(), target.stride()});
  }

  void writeResponse(size_t index, const Tile& tile, int row, int rows,
                     const Destination& destination) noexcept {
    const PlanStep& step = plan_.steps()[index];
    const int image_row = row - step.advance.y;
    RowBlock block{rows, tile.columns.size(), rings_[static_cast<size_t>(step.source)].stride(),
                   tile.columns.size()};
    bindInputs(index, row, step.advance.x - left_);
    if (destination.consumer != nullptr) {
      sums_[index].run(inputs_.data(), response_.data(), block);
      for (int i = 0; i < rows; ++i) {
        destination.consumer->consume({destination.plane, step.feature, image_row + i,
                                       tile.columns.start, block.columns,
                                       response_.data() + i * block.columns});
      }
      return;
    }
    const ResponsePlane& response = destination.planes[step.feature];
    block.target_stride = response.stride;
    std::int32_t* target = response.data + image_row * response.stride + tile.columns.start;
    const bool aligned =
        reinterpret_cast<std::uintptr_t>(target) % 16 == 0 && response.stride % 4 == 0;
    if (destination.streaming && aligned) {
      sums_[index].runStreaming(inputs_.data(), target, block);
    } else {
      sums_[index].run(inputs_.data(), target, block);
    }
  }

  const ConvolutionPlan& plan_;
  cv::Size size_;
  int left_ = 0;
  int top_ = 0;
  int bottom_ = 0;
  std::vector<RowRing> rings_;
  std::vector<size_t> integrals_;  ///< buffers of the integral image
  std::vector<RowSum> sums_;       ///< of the steps
  std::vector<std::uint8_t> pixels_;
  std::vector<std::uint8_t> zeros_;
  std::vector<std::int32_t> response_;
  std::vector<const void*> inputs_;
};

void requireUsable(const cv::Size& size, const ExecutorOptions& options) {
  if (size.width < 1 || size.height < 1) throw std::invalid_argument("the image is empty");
  if (options.threads < 1) {
    throw std::invalid_argument("threads is " + std::to_string(options.threads) +
                                ", must be at least 1");
  }
  if (options.strip_columns != 0 && options.strip_columns < kFullVector) {
    throw std::invalid_argument("strip_columns is " + std::to_string(options.strip_columns) +
                                ", must be 0 or at least " + std::to_string(kFullVector));
  }
}

}  // namespace

class BufferedExecutor::Implementation {
 public:
  Implementation(const ConvolutionPlan& plan, const cv::Size& size, const ExecutorOptions& options)
      : features_(plan.ensemble().size()), size_(size), options_(options) {
    requireUsable(size, options);
    options_.threads = std::min(options.threads, size.height);
    strip_columns_ =
        std::min(size.width, options.strip_columns != 0 ? options.strip_columns : kStripColumns);
    for (int i = 0; i < options_.threads; ++i) {
      runners_.emplace_back(plan, size, strip_columns_, bandOf(i).size(), options_);
    }
    team_ = std::make_unique<ThreadTeam>(options_.threads, [this](int member) { work(member); });
  }

  const cv::Size& size() const { return size_; }
  size_t features() const { return features_; }
  size_t workspaceBytes() const {
    size_t bytes = 0;
    for (const TileRunner& runner : runners_) bytes += runner.bytes();
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

  bool isStreaming() const {
    if (options_.streaming != Streaming::kAuto) return options_.streaming == Streaming::kAlways;
    return static_cast<size_t>(size_.area()) * features_ * static_cast<size_t>(plane_count_) *
               sizeof(std::int32_t) >
           kStreamedBytes;
  }

  void work(int member) {
    for (int plane = 0; plane < plane_count_; ++plane) {
      Destination destination;
      if (responses_ != nullptr)
        destination.planes = responses_ + static_cast<size_t>(plane) * features_;
      destination.consumer = consumer_;
      destination.plane = plane;
      destination.streaming = isStreaming();
      for (int column = 0; column < size_.width; column += strip_columns_) {
        const int end = std::min(size_.width, column + strip_columns_);
        runners_[static_cast<size_t>(member)].run(planes_[plane], {{column, end}, bandOf(member)},
                                                  destination);
      }
    }
  }

  size_t features_;
  cv::Size size_;
  ExecutorOptions options_;
  int strip_columns_ = 0;
  std::vector<TileRunner> runners_;
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
      throw std::invalid_argument(
          "the image has " + std::to_string(plane.cols) + " x " + std::to_string(plane.rows) +
          " pixels, the executor is made for " + std::to_string(size().width) + " x " +
          std::to_string(size().height));
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
