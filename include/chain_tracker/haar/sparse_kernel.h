// SPDX-License-Identifier: BSD-3-Clause
/// Sparse integer kernels, as polynomials in two delays: the kernel  sum_k w_k X^(dx_k) Y^(dy_k)
/// turns a signal S into  N(x, y) = sum_k w_k S(x - dx_k, y - dy_k). Convolving with one kernel
/// after another is multiplying them; a pass that needs no earlier result than its input is a
/// division that leaves no remainder.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace chain_tracker::haar {

struct KernelTap {
  int dy = 0;
  int dx = 0;
  std::int64_t weight = 0;

  bool operator==(const KernelTap& other) const {
    return dy == other.dy && dx == other.dx && weight == other.weight;
  }
  bool operator<(const KernelTap& other) const;
};

class SparseKernel {
 public:
  /// The zero kernel.
  SparseKernel() = default;
  /// Taps at the same place are added; those that vanish are left out.
  explicit SparseKernel(std::vector<KernelTap> taps);

  /// The kernel that changes nothing.
  static SparseKernel one();
  /// 1 - X^delay, and 1 - Y^delay.
  static SparseKernel differenceX(int delay);
  static SparseKernel differenceY(int delay);

  /// In the order of rows, then columns; no weight is zero.
  const std::vector<KernelTap>& taps() const { return taps_; }
  size_t size() const { return taps_.size(); }
  bool isZero() const { return taps_.empty(); }

  /// Delays of the first and last column and row that have taps; both zero for the zero kernel.
  cv::Point minDelay() const;
  cv::Point maxDelay() const;

  SparseKernel shifted(const cv::Point& delay) const;
  SparseKernel scaled(std::int64_t factor) const;
  SparseKernel operator*(const SparseKernel& other) const;
  SparseKernel operator+(const SparseKernel& other) const;

  /// The quotient by a kernel that is not zero, if it has whole weights and leaves no remainder.
  std::optional<SparseKernel> dividedBy(const SparseKernel& divisor) const;

  /// Like 1 + 2 X^3 - X Y^4.
  std::string text() const;

  bool operator==(const SparseKernel& other) const { return taps_ == other.taps_; }
  bool operator<(const SparseKernel& other) const { return taps_ < other.taps_; }

 private:
  std::vector<KernelTap> taps_;
};

/// kernel = scale * X^delay.x Y^delay.y * primitive, where the primitive kernel has its first row
/// and column at delay 0, weights without common divisor, and a positive first weight. Kernels with
/// the same primitive kernel are equal up to shift, sign and integer scale.
struct AlignedKernel {
  SparseKernel primitive;
  cv::Point delay;
  std::int64_t scale = 1;
};

/// O(taps). Throws std::invalid_argument for the zero kernel.
AlignedKernel alignedKernel(const SparseKernel& kernel);

}  // namespace chain_tracker::haar
