// SPDX-License-Identifier: BSD-3-Clause
/// Features as sparse kernels on the integral image.
///
/// II(x, y) is the sum of the pixels (i <= x, j <= y), on the whole plane: 0 left of and above the
/// image, constant right of and below it. Then image = (1 - X)(1 - Y) II, and a feature f is the
/// kernel (double difference of f) on II: the corners of its rectangles.
#pragma once

#include "chain_tracker/haar/haar_feature.h"
#include "chain_tracker/haar/sparse_kernel.h"

namespace chain_tracker::haar {

/// The corners of the feature: its response at (x, y) is  sum of weight * II(x - dx, y - dy).
/// Delays may be negative. The zero kernel where rectangles cancel.
SparseKernel doubleDifference(const HaarFeature& feature);

/// Least and largest value that a kernel on II can give for pixels in [0, max_pixel]: from the
/// sums of its positive and negative weights on the image. Nothing if the kernel is not divisible
/// by (1 - X)(1 - Y): then its values grow with the image.
struct ValueRange {
  std::int64_t low = 0;
  std::int64_t high = 0;

  bool within(std::int64_t least, std::int64_t largest) const {
    return least <= low && high <= largest;
  }
};
std::optional<ValueRange> rangeOnImage(const SparseKernel& kernel, int max_pixel);

}  // namespace chain_tracker::haar
