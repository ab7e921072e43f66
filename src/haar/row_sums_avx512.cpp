// SPDX-License-Identifier: BSD-3-Clause
// Compiled for AVX-512 with its instructions for bytes and words.
#include "row_sum_loops.h"

namespace chain_tracker::haar {

RowSum::Function avx512Loop(RowKind kind, const TapShape& shape, Write write) {
  return chooseLoop(kind, shape, write);
}

}  // namespace chain_tracker::haar
