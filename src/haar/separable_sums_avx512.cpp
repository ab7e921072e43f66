// SPDX-License-Identifier: BSD-3-Clause
// Sums of separable taps, compiled for AVX-512 with its instructions for bytes and words. The sums
// of columns stay in registers, where they are shifted against one another: nothing is written
// between the two passes, and all that is read is aligned.
#include "row_vectors.h"

namespace chain_tracker::haar {
namespace {

#ifdef __AVX512BW__

/// Takes the elements of a row of vectors from `delay` <= kLanes elements before their place.
CHAIN_TRACKER_INLINE Register delayIndices(int delay) {
  alignas(64) static constexpr std::uint16_t kPlaces[kLanes] = {
      0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 14, 15,
      16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31};
  return _mm512_sub_epi16(loadAs<Register>(kPlaces), _mm512_set1_epi16(static_cast<short>(delay)));
}

/// Indices are taken modulo twice the elements of a vector.
CHAIN_TRACKER_INLINE NarrowVector delayed(const NarrowVector& before, const NarrowVector& values,
                                          const Register& indices) {
  return reinterpret_cast<NarrowVector>(_mm512_permutex2var_epi16(
      reinterpret_cast<Register>(values), indices, reinterpret_cast<Register>(before)));
}

/// The column of the source with which the first vector ends up: aligned, if two vectors then still
/// hold all that the taps read.
CHAIN_TRACKER_INLINE int firstColumn(const RowTap* taps, int count, int column) {
  int least = taps[0].dx;
  int most = taps[0].dx;
  for (int k = 1; k < count; ++k) {
    least = taps[k].dx < least ? taps[k].dx : least;
    most = taps[k].dx > most ? taps[k].dx : most;
  }
  const int aligned = (column - least + kLanes - 1) & -kLanes;
  return aligned - (column - most) <= kLanes ? aligned : column - least;
}

template <Write kWrite, typename K, typename Column, typename Row>
void sumSeparable(const RowTap* taps, size_t, const RowStore& source, void* target,
                  const RowBlock& block) {
  using Access = VectorAccess<K>;
  const RowTap* const row_taps = taps + Column::kTaps;
  const int first = firstColumn(row_taps, Row::kTaps, block.column);
  std::uint16_t column_weights[Column::kTaps];
  std::uint16_t row_weights[Row::kTaps];
  Register indices[Row::kTaps];
  for (int k = 0; k < Column::kTaps; ++k) {
    column_weights[k] = static_cast<std::uint16_t>(taps[k].weight);
  }
  for (int k = 0; k < Row::kTaps; ++k) {
    row_weights[k] = static_cast<std::uint16_t>(row_taps[k].weight);
    indices[k] = delayIndices(first - block.column + row_taps[k].dx);
  }
  // In registers: the compiler must suppose that what is written changes what is not.
  const int rest = block.columns % kLanes;
  const std::ptrdiff_t vectors_end = block.columns - rest;
  for (int y = 0; y < block.rows; ++y) {
    const U16* from[Column::kTaps];
    for (int k = 0; k < Column::kTaps; ++k) {
      const int row = (block.row + y - taps[k].dy) & source.mask;
      from[k] = static_cast<const U16*>(source.first) + row * source.stride + first;
    }
    const auto column_sums = [&](std::ptrdiff_t x) {
      return sumOf<NarrowVector>(Column(), column_weights,
                                 [&](int k) { return Access::load(from[k] + x); });
    };
    auto* const to = static_cast<typename K::Target*>(target) + y * block.target_stride;
    NarrowVector before = column_sums(-kLanes);
    const auto next = [&](std::ptrdiff_t x) {
      const NarrowVector values = column_sums(x);
      const NarrowVector sums = sumOf<NarrowVector>(
          Row(), row_weights, [&](int k) { return delayed(before, values, indices[k]); });
      before = values;
      return sums;
    };
    for (std::ptrdiff_t x = 0; x < vectors_end; x += kLanes) {
      Access::template write<kWrite>(next(x), to + x);
    }
    if (rest != 0) Access::writeFirst(next(vectors_end), to + vectors_end, rest);
  }
}

template <typename... Shapes>
struct ShapeList {};

/// A difference of values; of two, three and four boxes; and of boxes apart from one another. The
/// first weight of a row is positive, that of a column may not be.
using Rows = ShapeList<Shape<1, 1, 0, 0, 0, 0>, Shape<2, 2, 0, 0, 0, 0>, Shape<2, 0, 0, 1, 2, 0>,
                       Shape<1, 1, 1, 1, 3, 0>>;
using Columns = ShapeList<Shape<1, 1, 0, 0, 0, 0>, Shape<2, 2, 0, 0, 0, 0>, Shape<2, 0, 0, 1, 2, 0>,
                          Shape<0, 2, 1, 0, 2, 0>, Shape<1, 1, 1, 1, 3, 0>>;

template <Write kWrite, typename K, typename Column, typename... Shapes>
RowSum::Function findRow(const TapShape& row, ShapeList<Shapes...>) {
  RowSum::Function found = nullptr;
  const auto take = [&](RowSum::Function loop) { return (found = loop) != nullptr; };
  static_cast<void>(
      ((Shapes::kShape == row && take(sumSeparable<kWrite, K, Column, Shapes>)) || ...));
  return found;
}

template <Write kWrite, typename K, typename... Shapes>
RowSum::Function findColumn(const TapShape& column, const TapShape& row, ShapeList<Shapes...>) {
  RowSum::Function found = nullptr;
  const auto take = [&](RowSum::Function loop) { return (found = loop) != nullptr; };
  static_cast<void>(
      ((Shapes::kShape == column && take(findRow<kWrite, K, Shapes>(row, Rows()))) || ...));
  return found;
}

template <Write kWrite>
RowSum::Function findLoop(RowKind kind, const TapShape& column, const TapShape& row) {
  switch (kind) {
    case RowKind::k16To16:
      return findColumn<Write::kThroughCaches, Kind<U16, U16, U16, U16>>(column, row, Columns());
    case RowKind::k16To32Signed:
      return findColumn<kWrite, Kind<U16, U16, S16, S32>>(column, row, Columns());
    case RowKind::k16To32Unsigned:
      return findColumn<kWrite, Kind<U16, U16, U16, S32>>(column, row, Columns());
    default:
      return nullptr;
  }
}

#endif

}  // namespace

#ifdef __AVX512BW__
RowSum::Function separableLoop(RowKind kind, const TapShape& column, const TapShape& row,
                               Write write) {
  if (write == Write::kAroundCaches) return findLoop<Write::kAroundCaches>(kind, column, row);
  return findLoop<Write::kThroughCaches>(kind, column, row);
}
#else
RowSum::Function separableLoop(RowKind, const TapShape&, const TapShape&, Write) { return nullptr; }
#endif

}  // namespace chain_tracker::haar
