// SPDX-License-Identifier: BSD-3-Clause
#include "haar/separable_taps.h"

#include <gtest/gtest.h>

#include "support/random_inputs.h"

namespace chain_tracker::haar {
namespace {

SparseKernel kernelOf(const std::vector<RowTap>& taps) {
  std::vector<KernelTap> kernel;
  for (const RowTap& tap : taps) kernel.push_back({tap.dy, tap.dx, tap.weight});
  return SparseKernel(kernel);
}

/// Weights that are not zero, at a few delays.
std::vector<RowTap> randomTaps(RandomInputs& random, bool is_row) {
  std::vector<RowTap> taps;
  for (int i = random.integer(1, 4), delay = random.integer(0, 5); i > 0; --i) {
    const int weight = random.integer(0, 1) == 0 ? random.integer(-4, -1) : random.integer(1, 4);
    taps.push_back({is_row ? delay : 0, is_row ? 0 : delay, weight});
    delay += random.integer(1, 5);
  }
  return taps;
}

TEST(SeparableTaps, multiplyToTheKernel) {
  RandomInputs random(1);
  for (int round = 0; round < 100; ++round) {
    const SparseKernel kernel =
        kernelOf(randomTaps(random, false)) * kernelOf(randomTaps(random, true));
    const auto taps = separableTaps(kernel);
    ASSERT_TRUE(taps);
    EXPECT_EQ(kernel.text(), (kernelOf(taps->column) * kernelOf(taps->row)).text());
    EXPECT_GT(taps->row.front().weight, 0);
    for (const RowTap& tap : taps->column) EXPECT_EQ(0, tap.dx);
    for (const RowTap& tap : taps->row) EXPECT_EQ(0, tap.dy);
  }
}

TEST(SeparableTaps, areNoneOfOtherKernels) {
  EXPECT_FALSE(separableTaps(SparseKernel()));
  EXPECT_FALSE(separableTaps(SparseKernel({{0, 0, 1}, {1, 1, 1}})));
  EXPECT_FALSE(separableTaps(SparseKernel({{0, 0, 1}, {0, 1, 2}, {1, 0, 2}, {1, 1, 2}})));
}

}  // namespace
}  // namespace chain_tracker::haar
