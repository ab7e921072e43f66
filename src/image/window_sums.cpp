// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/window_sums.h"

#include <algorithm>

#include "chain_tracker/image/multiversion.h"
#include "resizable_executor.h"
#include "reused_plane.h"

namespace chain_tracker {
namespace {

constexpr int kByteBits = 8;
constexpr int kLargestByte = 255;
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

WindowSums::WindowSums() = default;
WindowSums::WindowSums(WindowSums&&) noexcept = default;
WindowSums& WindowSums::operator=(WindowSums&&) noexcept = default;
WindowSums::~WindowSums() = default;

ResizableExecutor& WindowSums::executorFor(int window_cells, int max_byte) {
  const int planned = plannedByte(max_byte);
  std::unique_ptr<ResizableExecutor>& executor = executors_[{window_cells, planned}];
  if (!executor) {
    executor = std::make_unique<ResizableExecutor>(wholeWindow(window_cells), planOptions(planned));
  }
  return *executor;
}

const cv::Mat1i& WindowSums::compute(const cv::Mat1b& cells, int window_cells, int max_cell) {
  executorFor(window_cells, max_cell).run(cells, sums_);
  return sums_.front();
}

/// Sums are linear in the cells: those of the bytes of each place are added.
const cv::Mat1i& WindowSums::compute(const CellPlane& cells, int window_cells, int max_cell) {
  for (int shift = 0; shift == 0 || max_cell >> shift > 0; shift += kByteBits) {
    reuse(bytes_, cells.size());
    for (int row = 0; row < cells.rows; ++row) {
      takeByte(cells[row], shift, cells.cols, bytes_[row]);
    }
    const int max_byte = std::max(1, std::min(max_cell >> shift, kLargestByte));
    executorFor(window_cells, max_byte).run(bytes_, shift == 0 ? sums_ : higher_sums_);
    if (shift > 0) cv::scaleAdd(higher_sums_.front(), 1 << shift, sums_.front(), sums_.front());
  }
  return sums_.front();
}

}  // namespace chain_tracker
