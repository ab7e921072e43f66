// SPDX-License-Identifier: BSD-3-Clause
// Compiled for whatever the package is compiled for.
#include "row_sum_loops.h"

namespace chain_tracker::haar {

RowSum::Function portableLoop(RowKind kind, const TapShape& shape, Write write) {
  return chooseLoop(kind, shape, write);
}

}  // namespace chain_tracker::haar
