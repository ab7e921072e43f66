// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/haar/cost_model.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <stdexcept>
#include <tuple>
#include <type_traits>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "plan_loops.h"
#include "row_integral.h"
#include "row_rings.h"
#include "row_sums.h"
#include "step_sum.h"
#include "tap_shape.h"

namespace chain_tracker::haar {
namespace {

/// Rows of a line buffer: a power of two, as in plans of middling kernels.
constexpr int kRingRows = 64;
/// Columns and rows around the image that loops read.
constexpr int kBorder = 64;
/// Between columns of responses and those of the rings: hardly ever a multiple of a vector.
constexpr int kResponseShift = 13;
constexpr int kVector = 32;
/// A measurement is repeated as often as fits in so many seconds, but so many times; the fastest
/// counts, as other programs only ever slow it down.
constexpr double kSeconds = 0.1;
constexpr int kLeastRepetitions = 5;
/// Planes that a measurement writes in turn [bytes]: more are as far from the caches as these.
constexpr size_t kMostBytes = size_t{128} << 20;

double secondsOf(const std::function<void()>& work) {
  using Clock = std::chrono::steady_clock;
  double fastest = std::numeric_limits<double>::max();
  const auto begin = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  for (int i = 0; i < kLeastRepetitions || elapsed() < kSeconds; ++i) {
    const auto start = Clock::now();
    work();
    fastest = std::min(fastest, std::chrono::duration<double>(Clock::now() - start).count());
  }
  return fastest;
}

/// Where a loop reads and writes.
enum class Place { kLineBuffer, kImage };

struct Loop {
  RowKind kind;
  SeparableTaps taps;  ///< as in PlanLoop
  Place source;
  Place target;
};

int roundedUp(int value, int step) { return (value + step - 1) / step * step; }

/// Aligned as the rows of the executor are. Random: some machines write zeros faster than numbers.
class AlignedNumbers {
 public:
  explicit AlignedNumbers(size_t count) : memory_(count + kRowAlignment / sizeof(std::int32_t)) {
    std::minstd_rand random;
    for (std::int32_t& number : memory_) number = static_cast<std::int32_t>(random());
    const auto address = reinterpret_cast<std::uintptr_t>(memory_.data());
    first_ = memory_.data() +
             (kRowAlignment - address % kRowAlignment) % kRowAlignment / sizeof(std::int32_t);
  }
  std::int32_t* data() const { return first_; }

 private:
  std::vector<std::int32_t> memory_;
  std::int32_t* first_;
};

void appendShape(std::vector<int>& key, std::vector<RowTap> taps) {
  const TapShape shape = groupTaps(taps);
  key.insert(key.end(), {shape.plus, shape.minus, shape.common_plus, shape.common_minus,
                         shape.common, shape.other});
}

}  // namespace

class CostModel::Implementation {
 public:
  explicit Implementation(const cv::Size& size)
      : size_(required(size)),
        columns_(roundedUp(size.width, kVector) + 2 * kBorder),
        source_(static_cast<size_t>(columns_) *
                static_cast<size_t>(size.height + 2 * kBorder + kRingRows)),
        buffer_(static_cast<size_t>(columns_) * kBatchRows) {}

  double planSeconds(const ConvolutionPlan& plan) {
    const std::vector<PlanBuffer>& buffers = plan.buffers();
    double seconds = 0.0;
    for (const PlanBuffer& buffer : buffers) {
      if (buffer.node == 0) seconds += integralSeconds(buffer.lane) * elementsOf(buffer.reach);
    }
    for (const PlanLoop& loop : loopsOf(plan, InstructionSet::kBest)) {
      const bool is_response = loop.target < 0;
      const Reach reach = is_response ? Reach{} : buffers[static_cast<size_t>(loop.target)].reach;
      const Place target = is_response ? Place::kImage : Place::kLineBuffer;
      seconds += elementsOf(reach) * loopSeconds({loop.kind, loop.taps, Place::kLineBuffer, target},
                                                 plan.ensemble().size());
    }
    return seconds;
  }

  double classicSeconds(const ConvolutionPlan& plan) {
    double seconds = fullIntegralSeconds();
    for (const HaarFeature& feature : plan.ensemble().features()) {
      std::vector<RowTap> taps;
      const SparseKernel kernel = doubleDifference(feature);
      for (const KernelTap& tap : kernel.taps()) {
        taps.push_back({tap.dx, tap.dy, static_cast<std::int32_t>(tap.weight)});
      }
      const Loop loop{RowKind::k32To32, {taps, {}}, Place::kImage, Place::kImage};
      seconds += elementsOf({}) * loopSeconds(loop, plan.ensemble().size());
    }
    return seconds;
  }

 private:
  /// Kind, shapes of the taps, places, and bytes of the planes.
  using Key = std::tuple<RowKind, std::vector<int>, Place, Place, size_t>;

  static const cv::Size& required(const cv::Size& size) {
    if (size.width < 1 || size.height < 1) throw std::invalid_argument("the image is empty");
    return size;
  }

  /// Rows of buffers are whole vectors.
  double elementsOf(const Reach& reach) const {
    const int width = size_.width + reach.right - reach.left;
    const bool is_buffer = reach.right != reach.left;
    return static_cast<double>(is_buffer ? roundedUp(width, kVector) : width) *
           (size_.height + reach.bottom - reach.top);
  }

  double loopSeconds(const Loop& loop, size_t planes) {
    std::vector<int> shapes;
    appendShape(shapes, loop.taps.column);
    appendShape(shapes, loop.taps.row);
    const auto size = static_cast<size_t>(size_.area());
    const size_t bytes = loop.target == Place::kImage ? std::min(planes * size * 4, kMostBytes) : 0;
    const Key key(loop.kind, shapes, loop.source, loop.target, bytes);
    const auto known = loops_.find(key);
    if (known != loops_.end()) return known->second;
    const double seconds = bytes == 0 ? bufferSeconds(loop)
                                      : planeSeconds(loop, std::max<size_t>(1, bytes / size / 4),
                                                     cachedPlanes(size_, planes));
    return loops_[key] = seconds;
  }

  /// The source as the loop sees it; delays beyond the borders are cut.
  RowStore sourceOf(const Loop& loop) const {
    const std::int32_t* first = source_.data() + kBorder;
    if (loop.source == Place::kLineBuffer) return {first, kRingRows - 1, columns_};
    return {first + static_cast<std::ptrdiff_t>(kBorder) * columns_, -1, columns_};
  }

  RowSum sumOf(const Loop& loop) const {
    SeparableTaps taps = loop.taps;
    for (std::vector<RowTap>* part : {&taps.column, &taps.row}) {
      for (RowTap& tap : *part) {
        tap.dx = std::max(-kBorder, std::min(kBorder, tap.dx));
        tap.dy = std::max(-kBorder, std::min(kBorder, tap.dy));
      }
    }
    if (!taps.row.empty()) return RowSum::ofSeparable(loop.kind, taps).value();
    return {loop.kind, taps.column};
  }

  /// Seconds per element of a loop from a line buffer to a line buffer.
  double bufferSeconds(const Loop& loop) {
    const RowSum sum = sumOf(loop);
    const RowStore source = sourceOf(loop);
    const double seconds = secondsOf([&] {
      for (int row = 0; row < size_.height; row += kBatchRows) {
        sum.run(source, buffer_.data(), {row, 0, kBatchRows, size_.width, columns_});
      }
    });
    const int batches = (size_.height + kBatchRows - 1) / kBatchRows;
    return seconds / (static_cast<double>(batches) * kBatchRows * size_.width);
  }

  /// Seconds per element of a loop to planes in memory, the first ones through the caches. Plans go
  /// from plane to plane after every batch of rows, corner reads after every image.
  double planeSeconds(const Loop& loop, size_t planes, size_t cached_planes) {
    const RowSum sum = sumOf(loop);
    const RowStore source = sourceOf(loop);
    planes_.resize(std::max(planes_.size(), planes));
    for (cv::Mat1i& plane : planes_) plane.create(size_);
    const bool is_plan = loop.source == Place::kLineBuffer;
    const int batch = is_plan ? kBatchRows : size_.height;
    const int column = is_plan ? kResponseShift : 0;
    const bool can_stream = is_plan && size_.width % (kStreamAlignment / 4) == 0;
    const double seconds = secondsOf([&] {
      for (int row = 0; row < size_.height; row += batch) {
        const int rows = std::min(batch, size_.height - row);
        RowBlock block{row, column, rows, size_.width, size_.width};
        for (size_t i = 0; i < planes; ++i) {
          // Plans read other rows by then, which are not in the nearest cache any more.
          if (is_plan) block.row += kBatchRows;
          if (can_stream && i >= cached_planes) {
            sum.runStreaming(source, planes_[i][row], block);
          } else {
            sum.run(source, planes_[i][row], block);
          }
        }
      }
    });
    return seconds / (static_cast<double>(planes) * size_.area());
  }

  double integralSeconds(Lane lane) {
    const std::vector<std::uint8_t> pixels(static_cast<size_t>(size_.width));
    const AlignedNumbers rows(static_cast<size_t>(columns_) * kRingRows);
    const auto integrateAll = [&](auto* first) {
      using Sum = std::remove_pointer_t<decltype(first)>;
      for (int row = 1; row < kRingRows; ++row) {
        Sum* const target = first + static_cast<std::ptrdiff_t>(row) * columns_;
        integrateRow(pixels.data(), target - columns_, Sum{0}, target, size_.width,
                     InstructionSet::kBest);
      }
    };
    const double seconds = secondsOf([&] {
      if (lane == Lane::k32) {
        integrateAll(reinterpret_cast<std::uint32_t*>(rows.data()));
      } else {
        integrateAll(reinterpret_cast<std::uint16_t*>(rows.data()));
      }
    });
    return seconds / (static_cast<double>(size_.width) * (kRingRows - 1));
  }

  double fullIntegralSeconds() const {
    const cv::Mat1b image(size_, uchar{1});
    cv::Mat1b padded;
    cv::Mat1i integral;
    return secondsOf([&] {
      cv::copyMakeBorder(image, padded, 8, 8, 8, 8, cv::BORDER_CONSTANT, 0);
      cv::integral(padded, integral, CV_32S);
    });
  }

  cv::Size size_;
  int columns_;
  std::map<Key, double> loops_;  ///< seconds per element
  AlignedNumbers source_;
  AlignedNumbers buffer_;
  std::vector<cv::Mat1i> planes_;
};

CostModel::CostModel(const cv::Size& size)
    : implementation_(std::make_unique<Implementation>(size)) {}
CostModel::~CostModel() = default;
CostModel::CostModel(CostModel&&) noexcept = default;
CostModel& CostModel::operator=(CostModel&&) noexcept = default;

double CostModel::planSeconds(const ConvolutionPlan& plan) {
  return implementation_->planSeconds(plan);
}
double CostModel::classicSeconds(const ConvolutionPlan& plan) {
  return implementation_->classicSeconds(plan);
}

}  // namespace chain_tracker::haar
