// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/window_sums.h"

#include <algorithm>
#include <cstddef>

#include "chain_tracker/haar/buffered_executor.h"
#include "chain_tracker/image/multiversion.h"
#include "reused_plane.h"

namespace chain_tracker {
namespace {

constexpr int kByteBits = 8;
constexpr int kLargestByte = 255;
/// Executors are made for sizes that are multiples of this, so that few are made.
constexpr int kCapacityStep = 32;

int roundedUp(int value) { return (value + kCapacityStep - 1) / kCapacityStep * kCapacityStep; }

/// Plans are made for powers of four, so that few are made.
int plannedByte(int max_byte) {
  int power = 1;
  while (power < max_byte) power *= 4;
  return std::min(power, kLargestByte);
}

CHAIN_TRACKER_MULTIVERSION
void takeByte(const int* __restrict cell, int shift, int columns, uchar* __restrict byte) {
  for (int x = 0; x < columns; ++x) byte[x] = static_cast<uchar>(cell[x] >> shift);
}

haar::FeatureEnsemble wholeWindow(int window_cells) {
  return {"window", {{"sum", {{0, 0, window_cells, window_cells, 1}}}}};
}

haar::PlanOptions planOptions(int max_byte) {
  haar::PlanOptions options;
  options.max_pixel = max_byte;
  return options;
}

}  // namespace

struct WindowSums::Engine {
  Engine(int window_cells, int max_byte) : plan(wholeWindow(window_cells), planOptions(max_byte)) {}

  void resize(const cv::Size& size) {
    if (size.width > capacity.width || size.height > capacity.height) {
      capacity = {roundedUp(std::max(size.width, capacity.width)),
                  roundedUp(std::max(size.height, capacity.height))};
      executor = std::make_unique<haar::BufferedExecutor>(plan, capacity);
    }
    executor->setSize(size);
  }

  haar::ConvolutionPlan plan;
  cv::Size capacity;
  std::unique_ptr<haar::BufferedExecutor> executor;
};

WindowSums::WindowSums() = default;
WindowSums::WindowSums(WindowSums&&) noexcept = default;
WindowSums& WindowSums::operator=(WindowSums&&) noexcept = default;
WindowSums::~WindowSums() = default;

WindowSums::Engine& WindowSums::engineFor(int window_cells, int max_byte, const cv::Size& size) {
  const int planned = plannedByte(max_byte);
  std::unique_ptr<Engine>& engine = engines_[{window_cells, planned}];
  if (!engine) engine = std::make_unique<Engine>(window_cells, planned);
  engine->resize(size);
  return *engine;
}

void WindowSums::run(const cv::Mat1b& cells, int window_cells, int max_byte, cv::Mat1i& sums) {
  Engine& engine = engineFor(window_cells, max_byte, cells.size());
  reuse(sums, cells.size());
  const haar::BytePlane input{cells.ptr(), static_cast<std::ptrdiff_t>(cells.step1())};
  const haar::ResponsePlane output{sums[0], static_cast<std::ptrdiff_t>(sums.step1())};
  engine.executor->run(&input, 1, &output);
}

const cv::Mat1i& WindowSums::compute(const cv::Mat1b& cells, int window_cells, int max_cell) {
  run(cells, window_cells, max_cell, sums_);
  return sums_;
}

/// Sums are linear in the cells: those of the bytes of each place are added.
const cv::Mat1i& WindowSums::compute(const CellPlane& cells, int window_cells, int max_cell) {
  for (int shift = 0; shift == 0 || max_cell >> shift > 0; shift += kByteBits) {
    reuse(bytes_, cells.size());
    for (int row = 0; row < cells.rows; ++row) {
      takeByte(cells[row], shift, cells.cols, bytes_[row]);
    }
    const int max_byte = std::max(1, std::min(max_cell >> shift, kLargestByte));
    run(bytes_, window_cells, max_byte, shift == 0 ? sums_ : higher_sums_);
    if (shift > 0) cv::scaleAdd(higher_sums_, 1 << shift, sums_, sums_);
  }
  return sums_;
}

}  // namespace chain_tracker
