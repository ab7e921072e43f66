// SPDX-License-Identifier: BSD-3-Clause
/// The inner loops of the front end: weighted sums of rows, and running sums along a row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "chain_tracker/haar/instruction_set.h"

namespace chain_tracker::haar {

enum class RowKind {
  k16To16,          ///< 16-bit rows, summed modulo 2^16, to a 16-bit row
  k16To32Signed,    ///< the same, to a 32-bit row, the sum taken as signed
  k16To32Unsigned,  ///< the same, the sum taken as unsigned
  kSigned16To32,    ///< signed 16-bit rows, summed modulo 2^32, to a 32-bit row
  kUnsigned16To32,  ///< the same, unsigned
  k32To32           ///< 32-bit rows, summed modulo 2^32, to a 32-bit row
};

/// Most rows in one sum: the corners of kMaxRectangles rectangles.
constexpr size_t kMaxTaps = 256;

/// A block of rows that are summed in one go. Strides count elements of the rows.
struct RowBlock {
  int rows = 0;
  int columns = 0;
  std::ptrdiff_t source_stride = 0;
  std::ptrdiff_t target_stride = 0;
};

/// target[x] = sum of weight * row[x] with weights known beforehand, so that the loop can be
/// chosen that multiplies least.
class RowSum {
 public:
  RowSum(RowKind kind, const std::vector<std::int32_t>& weights,
         InstructionSet instructions = InstructionSet::kBest);

  /// Where each input of run() is among the weights given: first those of weight 1, then -1.
  const std::vector<size_t>& order() const { return order_; }

  /// `sources`: the first row of a block for each weight, in that order. The target is no source.
  void run(const void* const* sources, void* target, const RowBlock& block) const {
    sum_(sources, weights_.data(), weights_.size(), target, block);
  }

  /// The same, writing around the caches, to 32-bit rows aligned to 16 bytes.
  void runStreaming(const void* const* sources, std::int32_t* target, const RowBlock& block) const;

  using Function = void (*)(const void* const* sources, const std::int32_t* weights, size_t taps,
                            void* target, const RowBlock& block);

 private:
  RowKind kind_;
  std::vector<size_t> order_;
  std::vector<std::int32_t> weights_;
  Function sum_;
};

/// integral[x] = above[x] + pixels[0] + .. + pixels[x] modulo the element's size.
void integrateRow(const std::uint8_t* pixels, const std::uint16_t* above, std::uint16_t* integral,
                  int count);
void integrateRow(const std::uint8_t* pixels, const std::uint32_t* above, std::uint32_t* integral,
                  int count);

}  // namespace chain_tracker::haar
