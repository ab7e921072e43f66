// SPDX-License-Identifier: BSD-3-Clause
/// The inner loops of the front end: weighted sums of shifted rows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
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

/// Rows in memory, of which perhaps only the last ones are kept: element x of row r is
/// first[(r & mask) * stride + x].
struct RowStore {
  const void* first = nullptr;
  int mask = -1;
  std::ptrdiff_t stride = 0;  ///< in elements
};

struct RowTap {
  int dx = 0;
  int dy = 0;
  std::int32_t weight = 0;
};

/// Taps of a column (no dx) and of a row (no dy), whose product is meant.
struct SeparableTaps {
  std::vector<RowTap> column;
  std::vector<RowTap> row;
};

/// Of rows that are written around the caches: a line of the caches, and the widest vector.
constexpr int kStreamAlignment = 64;

/// Columns beside those read that sums of separable taps touch, without using what is there.
constexpr int kTouchedColumns = 64;

/// Where a block of sums begins, how large it is, and how far apart its target's rows are.
struct RowBlock {
  int row = 0;
  int column = 0;
  int rows = 0;
  int columns = 0;
  std::ptrdiff_t target_stride = 0;  ///< in elements
};

/// target(x, y) = sum of weight * source(column + x - dx, row + y - dy), with weights known
/// beforehand, so that the loop can be chosen that multiplies least.
class RowSum {
 public:
  RowSum(RowKind kind, const std::vector<RowTap>& taps,
         InstructionSet instructions = InstructionSet::kBest);

  /// The sum over the product of the taps without a pass between, where there is a loop for it.
  static std::optional<RowSum> ofSeparable(RowKind kind, const SeparableTaps& taps,
                                           InstructionSet instructions = InstructionSet::kBest);

  /// The target must not overlap with what is read. O(taps * rows * columns).
  void run(const RowStore& source, void* target, const RowBlock& block) const {
    sum_(taps_.data(), taps_.size(), source, target, block);
  }

  /// The same, writing around the caches, to 32-bit rows aligned to kStreamAlignment bytes.
  void runStreaming(const RowStore& source, std::int32_t* target, const RowBlock& block) const {
    streaming_sum_(taps_.data(), taps_.size(), source, target, block);
  }

  using Function = void (*)(const RowTap* taps, size_t count, const RowStore& source, void* target,
                            const RowBlock& block);

 private:
  RowSum() = default;

  std::vector<RowTap> taps_;
  Function sum_ = nullptr;
  Function streaming_sum_ = nullptr;
};

}  // namespace chain_tracker::haar
