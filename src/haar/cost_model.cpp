// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/haar/cost_model.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <tuple>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "row_integral.h"
#include "row_sums.h"
#include "step_sum.h"
#include "tap_shape.h"

namespace chain_tracker::haar {
namespace {

/// Rows of a line buffer: a power of two, as in plans of middling kernels.
constexpr int kRingRows = 64;
/// Columns around the image that loops read.
constexpr int kBorder = 64;
/// A measurement is repeated as often as fits in so many seconds, but so many times; the fastest
/// counts, as other programs only ever slow it down.
constexpr double kSeconds = 0.05;
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
  std::vector<RowTap> taps;
  Place source;
  Place target;
};

}  // namespace

class CostModel::Implementation {
 public:
  explicit Implementation(const cv::Size& size) : size_(size), columns_(size.width + 2 * kBorder) {
    if (size.width < 1 || size.height < 1) throw std::invalid_argument("the image is empty");
    const int rows = size.height + 2 * kBorder + kRingRows;
    source_.resize(static_cast<size_t>(columns_) * static_cast<size_t>(rows));
    buffer_.resize(static_cast<size_t>(columns_) * kBatchRows);
  }

  double planSeconds(const ConvolutionPlan& plan) {
    double seconds = 0.0;
    for (const PlanBuffer& buffer : plan.buffers()) {
      if (buffer.node == 0) seconds += integralSeconds(buffer.lane) * elementsOf(buffer.reach);
    }
    for (const PlanStep& step : plan.steps()) {
      const PlanBuffer& source = plan.buffers()[static_cast<size_t>(step.source)];
      const bool is_response = step.target < 0;
      const Reach reach =
          is_response ? Reach{} : plan.buffers()[static_cast<size_t>(step.target)].reach;
      const Loop loop{rowKindOf(step, source), tapsOf(step), Place::kLineBuffer,
                      is_response ? Place::kImage : Place::kLineBuffer};
      seconds += elementsOf(reach) * loopSeconds(loop, plan.ensemble().size());
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
      const Loop loop{RowKind::k32To32, taps, Place::kImage, Place::kImage};
      seconds += elementsOf({}) * loopSeconds(loop, plan.ensemble().size());
    }
    return seconds;
  }

 private:
  /// Kind, shape of the taps, places, and bytes of the planes.
  using Key = std::tuple<RowKind, std::vector<int>, Place, Place, size_t>;

  double elementsOf(const Reach& reach) const {
    return static_cast<double>(size_.width + reach.right - reach.left) *
           (size_.height + reach.bottom - reach.top);
  }

  double loopSeconds(const Loop& loop, size_t planes) {
    std::vector<RowTap> taps = loop.taps;
    const TapShape shape = groupTaps(taps);
    const std::vector<int> counts{shape.plus,         shape.minus,  shape.common_plus,
                                  shape.common_minus, shape.common, shape.other};
    const auto size = static_cast<size_t>(size_.area());
    const size_t bytes = loop.target == Place::kImage ? std::min(planes * size * 4, kMostBytes) : 0;
    const Key key(loop.kind, counts, loop.source, loop.target, bytes);
    const auto known = loops_.find(key);
    if (known != loops_.end()) return known->second;
    const double seconds = bytes == 0 ? bufferSeconds(loop)
                                      : planeSeconds(loop, std::max<size_t>(1, bytes / size / 4),
                                                     planes > cachedPlanes(size_, planes));
    return loops_[key] = seconds;
  }

  /// The source as the loop sees it; delays beyond the borders are cut.
  RowStore sourceOf(const Loop& loop) const {
    const std::int32_t* first = source_.data() + kBorder;
    if (loop.source == Place::kLineBuffer) return {first, kRingRows - 1, columns_};
    return {first + static_cast<std::ptrdiff_t>(kBorder) * columns_, -1, columns_};
  }

  RowSum sumOf(const Loop& loop) const {
    std::vector<RowTap> taps = loop.taps;
    for (RowTap& tap : taps) {
      tap.dx = std::max(-kBorder, std::min(kBorder, tap.dx));
      tap.dy = std::max(-kBorder, std::min(kBorder, tap.dy));
    }
    return {loop.kind, taps};
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

  /// Seconds per element of a loop to planes in memory. Plans go from plane to plane after every
  /// batch of rows, corner reads after every image.
  double planeSeconds(const Loop& loop, size_t planes, bool is_streamed) {
    const RowSum sum = sumOf(loop);
    const RowStore source = sourceOf(loop);
    planes_.resize(std::max(planes_.size(), planes));
    for (cv::Mat1i& plane : planes_) plane.create(size_);
    const bool is_plan = loop.source == Place::kLineBuffer;
    const int batch = is_plan ? kBatchRows : size_.height;
    const double seconds = secondsOf([&] {
      for (int row = 0; row < size_.height; row += batch) {
        const RowBlock block{row, 0, std::min(batch, size_.height - row), size_.width, size_.width};
        for (size_t i = 0; i < planes; ++i) {
          if (is_plan && is_streamed) {
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
    const double seconds = secondsOf([&] {
      for (int row = 1; row < kRingRows; ++row) {
        if (lane == Lane::k32) {
          auto* rows = reinterpret_cast<std::uint32_t*>(source_.data()) +
                       static_cast<std::ptrdiff_t>(row) * columns_;
          integrateRow(pixels.data(), rows - columns_, 0U, rows, size_.width,
                       InstructionSet::kBest);
        } else {
          auto* rows = reinterpret_cast<std::uint16_t*>(source_.data()) +
                       static_cast<std::ptrdiff_t>(row) * columns_;
          integrateRow(pixels.data(), rows - columns_, std::uint16_t{0}, rows, size_.width,
                       InstructionSet::kBest);
        }
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
  std::vector<std::int32_t> source_;
  std::vector<std::int32_t> buffer_;
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
