// SPDX-License-Identifier: BSD-3-Clause
/// The loops of row_sums.h over any taps; compiled once for every set of instructions, as
/// row_vectors.h.
#pragma once

#include "row_vectors.h"

/// The next loop writes nothing that it reads.
#if defined(__GNUC__) && !defined(__clang__)
#define CHAIN_TRACKER_INDEPENDENT _Pragma("GCC ivdep")
#else
#define CHAIN_TRACKER_INDEPENDENT
#endif

namespace chain_tracker::haar {
namespace {

/// Elements of a sum of many taps that are worked on at a time.
constexpr int kPiece = 128;

/// As many taps as the shape says.
template <Write kWrite, typename K, typename Taps>
CHAIN_TRACKER_INLINE void sumShape(const RowTap* taps, const RowStore& source,
                                   typename K::Target* __restrict target, const RowBlock& block) {
  using Source = typename K::Source;
  using Sum = typename K::Sum;
  const Source* from[Taps::kTaps];
  int rows_left[Taps::kTaps];  // until the store comes round
  Sum weights[Taps::kTaps];
  for (int k = 0; k < Taps::kTaps; ++k) {
    const int row = (block.row - taps[k].dy) & source.mask;
    from[k] =
        static_cast<const Source*>(source.first) + row * source.stride + block.column - taps[k].dx;
    rows_left[k] = source.mask - row;
    weights[k] = static_cast<Sum>(taps[k].weight);
  }
  const int columns = block.columns;
  for (int y = 0; y < block.rows; ++y) {
    int x = 0;
#ifdef CHAIN_TRACKER_VECTORS
    using Access = VectorAccess<K>;
    using Vector = typename Access::Vector;
    for (; x + Access::kElements <= columns; x += Access::kElements) {
      const auto vector = [&](int k) { return Access::load(from[k] + x); };
      Access::template write<kWrite>(sumOf<Vector>(Taps(), weights, vector), target + x);
    }
#endif
    CHAIN_TRACKER_INDEPENDENT
    for (; x < columns; ++x) {
      const auto value = [&](int k) { return static_cast<Sum>(from[k][x]); };
      const auto taken = static_cast<typename K::Taken>(sumOf<Sum>(Taps(), weights, value));
      target[x] = static_cast<typename K::Target>(taken);
    }
    target += block.target_stride;
    for (int k = 0; k < Taps::kTaps; ++k) {
      from[k] += rows_left[k]-- == 0 ? -source.mask * source.stride : source.stride;
    }
  }
}

/// Any number of taps: four at a time, on a piece of a row.
template <typename K>
CHAIN_TRACKER_INLINE void sumInGroups(const RowTap* taps, size_t count, const RowStore& source,
                                      typename K::Target* __restrict target,
                                      const RowBlock& block) {
  using Sum = typename K::Sum;
  using SumKind = Kind<typename K::Source, Sum, Sum, Sum>;
  constexpr size_t kGroup = 4;
  alignas(64) Sum sums[kPiece];
  alignas(64) Sum group[kPiece];
  for (int y = 0; y < block.rows; ++y) {
    for (int start = 0; start < block.columns; start += kPiece) {
      const int left = block.columns - start;
      const int length = left < kPiece ? left : kPiece;
      const RowBlock piece{block.row + y, block.column + start, 1, length, 0};
      for (Sum& sum : sums) sum = 0;
      for (size_t k = 0; k < count;) {
        const bool is_full = k + kGroup <= count;
        if (is_full) {
          sumShape<Write::kThroughCaches, SumKind, OtherTaps<kGroup>>(taps + k, source, group,
                                                                      piece);
        } else {
          sumShape<Write::kThroughCaches, SumKind, OtherTaps<1>>(taps + k, source, group, piece);
        }
        k += is_full ? kGroup : 1;
        for (int x = 0; x < length; ++x) sums[x] = static_cast<Sum>(sums[x] + group[x]);
      }
      typename K::Target* to = target + y * block.target_stride + start;
      for (int x = 0; x < length; ++x) {
        to[x] = static_cast<typename K::Target>(static_cast<typename K::Taken>(sums[x]));
      }
    }
  }
}

struct AnyTaps {
  static constexpr int kTaps = 0;
};

template <Write kWrite, typename K, typename Taps>
void sumTaps(const RowTap* taps, size_t count, const RowStore& source, void* target,
             const RowBlock& block) {
  auto* const rows = static_cast<typename K::Target*>(target);
  if constexpr (Taps::kTaps == 0) {
    sumInGroups<K>(taps, count, source, rows, block);
  } else {
    sumShape<kWrite, K, Taps>(taps, source, rows, block);
  }
}

template <typename... Shapes>
struct ShapeList {
  template <Write kWrite, typename K>
  static RowSum::Function find(const TapShape& wanted) {
    RowSum::Function found = nullptr;
    static_cast<void>(
        ((Shapes::kShape == wanted ? (found = sumTaps<kWrite, K, Shapes>, true) : false) || ...));
    return found;
  }
};

/// Copies, boxes, differences, and the edges, bars and grids of Haar-like features.
using CommonShapes =
    ShapeList<Shape<1, 0, 0, 0, 0, 0>, Shape<0, 1, 0, 0, 0, 0>, Shape<1, 1, 0, 0, 0, 0>,
              Shape<2, 0, 0, 0, 0, 0>, Shape<0, 2, 0, 0, 0, 0>, Shape<2, 1, 0, 0, 0, 0>,
              Shape<1, 2, 0, 0, 0, 0>, Shape<3, 0, 0, 0, 0, 0>, Shape<2, 2, 0, 0, 0, 0>,
              Shape<3, 3, 0, 0, 0, 0>, Shape<4, 4, 0, 0, 0, 0>, Shape<8, 8, 0, 0, 0, 0>,
              Shape<2, 0, 0, 1, 2, 0>, Shape<0, 2, 1, 0, 2, 0>, Shape<1, 1, 1, 1, 2, 0>,
              Shape<1, 1, 1, 1, 3, 0>, Shape<2, 2, 1, 1, 2, 0>, Shape<2, 2, 2, 2, 2, 0>,
              Shape<2, 2, 2, 2, 3, 0>, Shape<4, 0, 0, 4, 2, 1>, Shape<0, 4, 4, 0, 2, 1>>;

using CountedTaps =
    ShapeList<OtherTaps<1>, OtherTaps<2>, OtherTaps<3>, OtherTaps<4>, OtherTaps<5>, OtherTaps<6>,
              OtherTaps<7>, OtherTaps<8>, OtherTaps<9>, OtherTaps<10>, OtherTaps<12>>;

template <Write kWrite, typename K>
RowSum::Function chooseLoop(const TapShape& shape) {
  if (const auto loop = CommonShapes::find<kWrite, K>(shape)) return loop;
  TapShape others;
  others.other = shape.taps();
  if (const auto loop = CountedTaps::find<kWrite, K>(others)) return loop;
  return sumTaps<kWrite, K, AnyTaps>;
}

template <Write kWrite>
RowSum::Function chooseLoop(RowKind kind, const TapShape& shape) {
  switch (kind) {
    case RowKind::k16To16:
      return chooseLoop<Write::kThroughCaches, Kind<U16, U16, U16, U16>>(shape);
    case RowKind::k16To32Signed:
      return chooseLoop<kWrite, Kind<U16, U16, S16, S32>>(shape);
    case RowKind::k16To32Unsigned:
      return chooseLoop<kWrite, Kind<U16, U16, U16, S32>>(shape);
    case RowKind::kSigned16To32:
      return chooseLoop<kWrite, Kind<S16, U32, S32, S32>>(shape);
    case RowKind::kUnsigned16To32:
      return chooseLoop<kWrite, Kind<U16, U32, S32, S32>>(shape);
    case RowKind::k32To32:
      break;
  }
  return chooseLoop<kWrite, Kind<U32, U32, S32, S32>>(shape);
}

RowSum::Function chooseLoop(RowKind kind, const TapShape& shape, Write write) {
  if (write == Write::kAroundCaches) return chooseLoop<Write::kAroundCaches>(kind, shape);
  return chooseLoop<Write::kThroughCaches>(kind, shape);
}

}  // namespace
}  // namespace chain_tracker::haar

#undef CHAIN_TRACKER_INDEPENDENT
