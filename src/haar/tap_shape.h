// SPDX-License-Identifier: BSD-3-Clause
/// How many taps of a sum have which weights: what a loop must know to multiply least.
#pragma once

#include <vector>

#include "row_sums.h"

namespace chain_tracker::haar {

/// sum = plus - minus + common * (common_plus - common_minus) + others, each with its own weight.
struct TapShape {
  int plus = 0;
  int minus = 0;
  int common_plus = 0;
  int common_minus = 0;
  int common = 0;  ///< the most frequent size of a weight but 1; 0 if there is none
  int other = 0;

  int taps() const;
  bool operator==(const TapShape& shape) const;
};

/// Puts the taps into the order of the members above.
TapShape groupTaps(std::vector<RowTap>& taps);

/// How sums are written.
enum class Write { kThroughCaches, kAroundCaches };

/// The loop for taps of a shape: with the instructions that the package is compiled for, or with
/// those of AVX2 or AVX-512BW, which the machine must have.
RowSum::Function portableLoop(RowKind kind, const TapShape& shape, Write write);
RowSum::Function avx2Loop(RowKind kind, const TapShape& shape, Write write);
RowSum::Function avx512Loop(RowKind kind, const TapShape& shape, Write write);

/// The loop for a column of taps times a row of taps, with AVX-512BW; null if there is none.
RowSum::Function separableLoop(RowKind kind, const TapShape& column, const TapShape& row,
                               Write write);

}  // namespace chain_tracker::haar
