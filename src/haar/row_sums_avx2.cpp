// SPDX-License-Identifier: BSD-3-Clause
// Compiled for AVX2.
#include "row_sum_loops.h"

namespace chain_tracker::haar {

RowSum::Function avx2Loop(RowKind kind, const TapShape& shape, Write write) {
  return chooseLoop(kind, shape, write);
}

}  // namespace chain_tracker::haar
