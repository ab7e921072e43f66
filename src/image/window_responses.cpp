// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/window_responses.h"

#include <algorithm>

#include "chain_tracker/image/multiversion.h"
#include "reused_plane.h"

namespace chain_tracker {
namespace {

constexpr int kByteBits = 8;
constexpr int kLargestByte = 255;
/// Executors are made for sizes that are multiples of this, so that few are made.
constexpr int kCapacityStep = 32;

int roundedUp(int value) { return (value + kCapacityStep - 1) / kCapacityStep * kCapacityStep; }

int bytesOf(int value) { return value <= kLargestByte ? 1 : 1 + bytesOf(value >> kByteBits); }

CHAIN_TRACKER_MULTIVERSION
void takeByte(const int* __restrict cell, int shift, int columns, uchar* __restrict byte) {
  for (int x = 0; x < columns; ++x) byte[x] = static_cast<uchar>(cell[x] >> shift);
}

haar::PlanOptions planOptions(int max_byte) {
  haar::PlanOptions options;
  options.max_pixel = max_byte;
  return options;
}

}  // namespace

struct WindowResponses::Engine {
  Engine(haar::FeatureEnsemble ensemble, int max_byte)
      : plan(std::move(ensemble), planOptions(max_byte)) {}

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

WindowResponses::WindowResponses(EnsembleOf ensemble_of) : ensemble_of_(std::move(ensemble_of)) {}
WindowResponses::WindowResponses(WindowResponses&&) noexcept = default;
WindowResponses& WindowResponses::operator=(WindowResponses&&) noexcept = default;
WindowResponses::~WindowResponses() = default;

WindowResponses::Engine& WindowResponses::engineFor(int window_cells, int max_byte,
                                                    const cv::Size& size) {
  std::unique_ptr<Engine>& engine = engines_[{window_cells, max_byte}];
  if (!engine) engine = std::make_unique<Engine>(ensemble_of_(window_cells), max_byte);
  engine->resize(size);
  return *engine;
}

void WindowResponses::addPlane(const cv::Mat1b& plane) {
  inputs_.push_back({plane.ptr(), static_cast<std::ptrdiff_t>(plane.step1())});
}

/// Convolves the planes added since the last run.
WindowResponses::Engine& WindowResponses::run(int window_cells, int max_byte,
                                              const cv::Size& size) {
  Engine& engine = engineFor(window_cells, max_byte, size);
  const size_t responses = inputs_.size() * engine.plan.ensemble().size();
  responses_.resize(std::max(responses_.size(), responses));
  outputs_.clear();
  for (size_t i = 0; i < responses; ++i) {
    reuse(responses_[i], size);
    outputs_.push_back({responses_[i][0], static_cast<std::ptrdiff_t>(responses_[i].step1())});
  }
  engine.executor->run(inputs_.data(), static_cast<int>(inputs_.size()), outputs_.data());
  inputs_.clear();
  return engine;
}

const std::vector<cv::Mat1i>& WindowResponses::compute(const cv::Mat1b& cells, int window_cells,
                                                       int max_cell) {
  addPlane(cells);
  run(window_cells, max_cell, cells.size());
  return responses_;
}

const std::vector<cv::Mat1i>& WindowResponses::compute(const CellPlane& cells, int window_cells,
                                                       int max_cell) {
  bytes_.resize(std::max(bytes_.size(), static_cast<size_t>(bytesOf(max_cell))));
  for (int i = 0; i < bytesOf(max_cell); ++i) {
    cv::Mat1b& bytes = bytes_[static_cast<size_t>(i)];
    reuse(bytes, cells.size());
    for (int row = 0; row < cells.rows; ++row) {
      takeByte(cells[row], kByteBits * i, cells.cols, bytes[row]);
    }
    addPlane(bytes);
  }
  const Engine& engine = run(window_cells, std::min(max_cell, kLargestByte), cells.size());
  // Responses are linear in the cells.
  const size_t features = engine.plan.ensemble().size();
  for (size_t i = features; i < outputs_.size(); ++i) {
    const int shift = kByteBits * static_cast<int>(i / features);
    cv::scaleAdd(responses_[i], 1 << shift, responses_[i % features], responses_[i % features]);
  }
  return responses_;
}

}  // namespace chain_tracker
