// SPDX-License-Identifier: BSD-3-Clause
/// The inner loops of the front end: weighted sums of rows, and running sums along a row.
#pragma once

#include <cstddef>
#include <cstdint>

namespace chain_tracker::haar {

enum class RowKind {
  k16To16,          ///< 16-bit rows, summed modulo 2^16, to a 16-bit row
  k16To32Signed,    ///< the same, to a 32-bit row, the sum taken as signed
  k16To32Unsigned,  ///< the same, the sum taken as unsigned
  kSigned16To32,    ///< signed 16-bit rows, summed modulo 2^32, to a 32-bit row
  kUnsigned16To32,  ///< the same, unsigned
  k32To32           ///< 32-bit rows, summed modulo 2^32, to a 32-bit row
};

struct RowInput {
  const void* row = nullptr;  ///< elements as the kind says
  std::int32_t weight = 0;
};

struct RowSum {
  RowKind kind = RowKind::k32To32;
  /// Whether the target is written around the caches; it must then be aligned to 16 bytes.
  bool streaming = false;
};

/// target[x] = sum of weight * row[x] for x in [0, count). The target is no input.
void sumRows(const RowSum& sum, const RowInput* inputs, size_t input_count, void* target,
             int count);

/// integral[x] = above[x] + pixels[0] + .. + pixels[x] modulo the element's size.
void integrateRow(const std::uint8_t* pixels, const std::uint16_t* above, std::uint16_t* integral,
                  int count);
void integrateRow(const std::uint8_t* pixels, const std::uint32_t* above, std::uint32_t* integral,
                  int count);

/// narrow[x] = wide[x] modulo 2^16.
void narrowRow(const std::uint32_t* wide, std::uint16_t* narrow, int count);

}  // namespace chain_tracker::haar
