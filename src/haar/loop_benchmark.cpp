// SPDX-License-Identifier: BSD-3-Clause
#include "loop_benchmark.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <random>
#include <sstream>
#include <type_traits>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "row_integral.h"
#include "row_rings.h"
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
constexpr double kSeconds = 0.02;
constexpr int kLeastRepetitions = 4;
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

/// Weights that are multiplied one by one take the same time, whatever they are.
void appendShape(std::ostream& name, std::vector<RowTap> taps) {
  const TapShape shape = groupTaps(taps);
  for (int part : {shape.plus, shape.minus, shape.common_plus, shape.common_minus, shape.common,
                   shape.other}) {
    name << ' ' << part;
  }
}

const char* nameOf(Place place) { return place == Place::kImage ? "image" : "buffer"; }

RowSum sumOf(const MeasuredLoop& loop) {
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

}  // namespace

class LoopBenchmark::Memory {
 public:
  explicit Memory(const cv::Size& size)
      : columns(roundedUp(size.width, kVector) + 2 * kBorder),
        buffer(static_cast<size_t>(columns) * kBatchRows),
        source_(static_cast<size_t>(columns + 1) *
                static_cast<size_t>(size.height + 2 * kBorder + kRingRows)) {}

  /// The source as the loop sees it; delays beyond the borders are cut.
  RowStore sourceOf(const MeasuredLoop& loop) const {
    const std::int32_t* first = source_.data() + kBorder;
    if (loop.source == Place::kLineBuffer) return {first, kRingRows - 1, columns};
    // Rows of integral images are one element longer than those of images: hardly ever aligned.
    const std::ptrdiff_t stride = columns + 1;
    return {first + kBorder * stride, -1, stride};
  }

  int columns;
  AlignedNumbers buffer;
  std::vector<cv::Mat1i> planes;

 private:
  AlignedNumbers source_;
};

LoopBenchmark::LoopBenchmark(const cv::Size& size) : size_(size) {}
LoopBenchmark::~LoopBenchmark() = default;

Measurement LoopBenchmark::ofLoop(const MeasuredLoop& loop) {
  const bool is_image = loop.target == Place::kImage;
  std::ostringstream name;
  name << "sum " << static_cast<int>(loop.kind) << " column";
  appendShape(name, loop.taps.column);
  name << " row";
  appendShape(name, loop.taps.row);
  name << " from " << haar::nameOf(loop.source) << " to " << haar::nameOf(loop.target);
  if (is_image) {
    name << "s " << writtenPlanes(loop) << " cached " << cachedPlanes(size_, loop.planes);
  }
  return {nameOf(name.str()),
          [this, loop, is_image] { return is_image ? planeSeconds(loop) : bufferSeconds(loop); }};
}

Measurement LoopBenchmark::ofIntegral(Lane lane) {
  return {nameOf(lane == Lane::k32 ? "integral 32" : "integral 16"),
          [this, lane] { return integralSeconds(lane); }};
}

Measurement LoopBenchmark::ofFullIntegral() {
  return {nameOf("cv::integral"), [this] { return fullIntegralSeconds(); }};
}

std::string LoopBenchmark::nameOf(const std::string& loop) const {
  return std::to_string(size_.width) + "x" + std::to_string(size_.height) + " " + loop;
}

LoopBenchmark::Memory& LoopBenchmark::memory() {
  if (!memory_) memory_ = std::make_unique<Memory>(size_);
  return *memory_;
}

size_t LoopBenchmark::writtenPlanes(const MeasuredLoop& loop) const {
  const size_t plane_bytes = static_cast<size_t>(std::max(1, size_.area())) * sizeof(std::int32_t);
  return std::max<size_t>(1, std::min(loop.planes, kMostBytes / plane_bytes));
}

double LoopBenchmark::bufferSeconds(const MeasuredLoop& loop) {
  const RowSum sum = sumOf(loop);
  const Memory& space = memory();
  const RowStore source = space.sourceOf(loop);
  const double seconds = secondsOf([&] {
    for (int row = 0; row < size_.height; row += kBatchRows) {
      sum.run(source, space.buffer.data(), {row, 0, kBatchRows, size_.width, space.columns});
    }
  });
  const int batches = (size_.height + kBatchRows - 1) / kBatchRows;
  return seconds / (static_cast<double>(batches) * kBatchRows * size_.width);
}

/// Of a loop to planes in memory, the first ones through the caches. Plans go
/// from plane to plane after every batch of rows, corner reads after every image.
double LoopBenchmark::planeSeconds(const MeasuredLoop& loop) {
  const RowSum sum = sumOf(loop);
  const RowStore source = memory().sourceOf(loop);
  std::vector<cv::Mat1i>& targets = memory().planes;
  const size_t planes = writtenPlanes(loop);
  const size_t cached_planes = cachedPlanes(size_, loop.planes);
  targets.resize(std::max(targets.size(), planes));
  for (cv::Mat1i& plane : targets) plane.create(size_);
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
          sum.runStreaming(source, targets[i][row], block);
        } else {
          sum.run(source, targets[i][row], block);
        }
      }
    }
  });
  return seconds / (static_cast<double>(planes) * size_.area());
}

double LoopBenchmark::integralSeconds(Lane lane) {
  const std::vector<std::uint8_t> pixels(static_cast<size_t>(size_.width));
  const int columns = memory().columns;
  const AlignedNumbers rows(static_cast<size_t>(columns) * kRingRows);
  const auto integrate_all = [&](auto* first) {
    using Sum = std::remove_pointer_t<decltype(first)>;
    for (int row = 1; row < kRingRows; ++row) {
      Sum* const target = first + static_cast<std::ptrdiff_t>(row) * columns;
      integrateRow(pixels.data(), target - columns, Sum{0}, target, size_.width,
                   InstructionSet::kBest);
    }
  };
  const double seconds = secondsOf([&] {
    if (lane == Lane::k32) {
      integrate_all(reinterpret_cast<std::uint32_t*>(rows.data()));
    } else {
      integrate_all(reinterpret_cast<std::uint16_t*>(rows.data()));
    }
  });
  return seconds / (static_cast<double>(size_.width) * (kRingRows - 1));
}

double LoopBenchmark::fullIntegralSeconds() const {
  const cv::Mat1b image(size_, uchar{1});
  cv::Mat1b padded;
  cv::Mat1i integral;
  return secondsOf([&] {
    cv::copyMakeBorder(image, padded, 8, 8, 8, 8, cv::BORDER_CONSTANT, 0);
    cv::integral(padded, integral, CV_32S);
  });
}

}  // namespace chain_tracker::haar
