// SPDX-License-Identifier: BSD-3-Clause
/// The loops of row_sums.h. This header is compiled once for every set of instructions, so all that
/// it defines is local to the file that includes it, and it uses no template of the standard
/// library: the linker would merge its copies.
#pragma once

#include <cstring>
#include <type_traits>

#include "row_sums.h"
#include "tap_shape.h"

#ifdef __AVX2__
#define CHAIN_TRACKER_VECTORS
#include <immintrin.h>
#endif

#if defined(__GNUC__)
#define CHAIN_TRACKER_INLINE inline __attribute__((always_inline))
#else
#define CHAIN_TRACKER_INLINE inline
#endif

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

/// One kind of row sum: types of the source's elements, of the sum (unsigned: it wraps around), of
/// what the sum is taken as, and of the target.
template <typename SourceType, typename SumType, typename TakenType, typename TargetType>
struct Kind {
  using Source = SourceType;
  using Sum = SumType;
  using Taken = TakenType;
  using Target = TargetType;
};

/// tap_shape.h, known to the compiler.
template <int kPlus, int kMinus, int kCommonPlus, int kCommonMinus, int kCommon, int kOther>
struct Shape {
  static constexpr TapShape kShape{kPlus, kMinus, kCommonPlus, kCommonMinus, kCommon, kOther};
  static constexpr int kTaps = kPlus + kMinus + kCommonPlus + kCommonMinus + kOther;
};
template <int kTaps>
using OtherTaps = Shape<0, 0, 0, 0, 0, kTaps>;

template <typename Element>
CHAIN_TRACKER_INLINE Element product(Element value, Element weight) {
  return static_cast<Element>(value * std::uint32_t{weight});
}

#ifdef CHAIN_TRACKER_VECTORS
#ifdef __AVX512BW__
using Register = __m512i;
#else
using Register = __m256i;
#endif
constexpr int kLanes = sizeof(Register) / sizeof(std::uint16_t);
constexpr int kHalfLanes = kLanes / 2;

template <typename T, int kSize>
struct VectorOf {
  typedef T Type __attribute__((vector_size(kSize * sizeof(T))));
};
using NarrowVector = VectorOf<std::uint16_t, kLanes>::Type;
using HalfVector = VectorOf<std::uint32_t, kHalfLanes>::Type;

/// As many values of 32 bits as a vector holds of 16.
struct WideVector {
  HalfVector halves[2];

  CHAIN_TRACKER_INLINE WideVector operator+(const WideVector& other) const {
    return {{halves[0] + other.halves[0], halves[1] + other.halves[1]}};
  }
  CHAIN_TRACKER_INLINE WideVector operator-(const WideVector& other) const {
    return {{halves[0] - other.halves[0], halves[1] - other.halves[1]}};
  }
};

CHAIN_TRACKER_INLINE NarrowVector product(const NarrowVector& values, std::uint16_t weight) {
  return values * weight;
}
CHAIN_TRACKER_INLINE HalfVector product(const HalfVector& values, std::uint32_t weight) {
  return values * weight;
}
CHAIN_TRACKER_INLINE WideVector product(const WideVector& values, std::uint32_t weight) {
  return {{values.halves[0] * weight, values.halves[1] * weight}};
}

template <typename Vector, typename Element>
CHAIN_TRACKER_INLINE Vector loadAs(const Element* from) {
  Vector values;
  std::memcpy(&values, from, sizeof(values));
  return values;
}

#ifdef __AVX512BW__
/// The values of 16-bit vectors, signed or unsigned as `Element` is, in the order in which
/// storeWide() takes them.
template <typename Element>
CHAIN_TRACKER_INLINE WideVector wide(Register values) {
  const __m256i low = _mm512_castsi512_si256(values);
  const __m256i high = _mm512_extracti64x4_epi64(values, 1);
  if constexpr (std::is_signed_v<Element>) {
    return {{reinterpret_cast<HalfVector>(_mm512_cvtepi16_epi32(low)),
             reinterpret_cast<HalfVector>(_mm512_cvtepi16_epi32(high))}};
  } else {
    return {{reinterpret_cast<HalfVector>(_mm512_cvtepu16_epi32(low)),
             reinterpret_cast<HalfVector>(_mm512_cvtepu16_epi32(high))}};
  }
}

template <Write kWrite>
CHAIN_TRACKER_INLINE void store(Register values, void* to) {
  if constexpr (kWrite == Write::kAroundCaches) {
    auto* const quarters = static_cast<__m128i*>(to);
    _mm_stream_si128(quarters, _mm512_castsi512_si128(values));
    _mm_stream_si128(quarters + 1, _mm512_extracti32x4_epi32(values, 1));
    _mm_stream_si128(quarters + 2, _mm512_extracti32x4_epi32(values, 2));
    _mm_stream_si128(quarters + 3, _mm512_extracti32x4_epi32(values, 3));
  } else {
    std::memcpy(to, &values, sizeof(values));
  }
}

template <Write kWrite>
CHAIN_TRACKER_INLINE void storeWide(const WideVector& sums, void* to) {
  store<kWrite>(reinterpret_cast<Register>(sums.halves[0]), to);
  store<kWrite>(reinterpret_cast<Register>(sums.halves[1]), static_cast<Register*>(to) + 1);
}
#else
/// The values of 16-bit vectors, signed or unsigned as `Element` is, in the order in which
/// storeWide() takes them: that in which the machine widens them, the middle quarters having
/// changed places.
template <typename Element>
CHAIN_TRACKER_INLINE WideVector wide(Register values) {
  const __m256i high_bits =
      std::is_signed_v<Element> ? _mm256_srai_epi16(values, 15) : _mm256_setzero_si256();
  return {{reinterpret_cast<HalfVector>(_mm256_unpacklo_epi16(values, high_bits)),
           reinterpret_cast<HalfVector>(_mm256_unpackhi_epi16(values, high_bits))}};
}

template <Write kWrite>
CHAIN_TRACKER_INLINE void store(Register values, void* to) {
  if constexpr (kWrite == Write::kAroundCaches) {
    auto* const halves = static_cast<__m128i*>(to);
    _mm_stream_si128(halves, _mm256_castsi256_si128(values));
    _mm_stream_si128(halves + 1, _mm256_extracti128_si256(values, 1));
  } else {
    std::memcpy(to, &values, sizeof(values));
  }
}

template <Write kWrite>
CHAIN_TRACKER_INLINE void storeWide(const WideVector& sums, void* to) {
  const auto first = reinterpret_cast<Register>(sums.halves[0]);
  const auto second = reinterpret_cast<Register>(sums.halves[1]);
  store<kWrite>(_mm256_permute2x128_si256(first, second, 0x20), to);
  store<kWrite>(_mm256_permute2x128_si256(first, second, 0x31), static_cast<Register*>(to) + 1);
}
#endif

/// How the vectors of each kind are read, and how their sums are written.
template <typename K, size_t kSourceBytes = sizeof(typename K::Source),
          size_t kSumBytes = sizeof(typename K::Sum),
          size_t kTargetBytes = sizeof(typename K::Target)>
struct VectorAccess;

template <typename K>
struct VectorAccess<K, 2, 2, 2> {
  using Vector = NarrowVector;
  static constexpr int kElements = kLanes;
  static CHAIN_TRACKER_INLINE Vector load(const std::uint16_t* from) {
    return loadAs<Vector>(from);
  }
  template <Write kWrite>
  static CHAIN_TRACKER_INLINE void write(const Vector& sums, void* to) {
    std::memcpy(to, &sums, sizeof(sums));
  }
};

template <typename K>
struct VectorAccess<K, 2, 2, 4> : VectorAccess<K, 2, 2, 2> {
  template <Write kWrite>
  static CHAIN_TRACKER_INLINE void write(const NarrowVector& sums, void* to) {
    storeWide<kWrite>(wide<typename K::Taken>(reinterpret_cast<Register>(sums)), to);
  }
};

template <typename K>
struct VectorAccess<K, 2, 4, 4> {
  using Vector = WideVector;
  static constexpr int kElements = kLanes;
  static CHAIN_TRACKER_INLINE Vector load(const typename K::Source* from) {
    return wide<typename K::Source>(loadAs<Register>(from));
  }
  template <Write kWrite>
  static CHAIN_TRACKER_INLINE void write(const Vector& sums, void* to) {
    storeWide<kWrite>(sums, to);
  }
};

template <typename K>
struct VectorAccess<K, 4, 4, 4> {
  using Vector = HalfVector;
  static constexpr int kElements = kHalfLanes;
  static CHAIN_TRACKER_INLINE Vector load(const std::uint32_t* from) {
    return loadAs<Vector>(from);
  }
  template <Write kWrite>
  static CHAIN_TRACKER_INLINE void write(const Vector& sums, void* to) {
    store<kWrite>(reinterpret_cast<Register>(sums), to);
  }
};
#endif

/// The sum of values, in the order of the shape; `Value` is an element or a vector of them.
template <typename Value, typename Element, typename Taps, typename ValueOf>
CHAIN_TRACKER_INLINE Value sumOf(Taps, const Element* weights, const ValueOf& value) {
  constexpr TapShape kShape = Taps::kShape;
  constexpr int kCommonStart = kShape.plus + kShape.minus;
  constexpr int kCommonMinusStart = kCommonStart + kShape.common_plus;
  constexpr int kOtherStart = kCommonMinusStart + kShape.common_minus;
  Value common{};
  for (int k = kCommonStart; k < kCommonMinusStart; ++k) {
    common = static_cast<Value>(common + value(k));
  }
  // Of values that are only taken away, the sum is taken away: nothing is negated.
  constexpr bool kIsNegative = kShape.common_plus == 0;
  for (int k = kCommonMinusStart; k < kOtherStart; ++k) {
    common = static_cast<Value>(kIsNegative ? common + value(k) : common - value(k));
  }
  Value sum{};
  for (int k = 0; k < kShape.plus; ++k) sum = static_cast<Value>(sum + value(k));
  for (int k = kShape.plus; k < kCommonStart; ++k) sum = static_cast<Value>(sum - value(k));
  if constexpr (kShape.common != 0) {
    common = product(common, static_cast<Element>(kShape.common));
    sum = static_cast<Value>(kIsNegative ? sum - common : sum + common);
  }
  for (int k = kOtherStart; k < Taps::kTaps; ++k) {
    sum = static_cast<Value>(sum + product(value(k), weights[k]));
  }
  return sum;
}

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

using U16 = std::uint16_t;
using S16 = std::int16_t;
using U32 = std::uint32_t;
using S32 = std::int32_t;

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

#undef CHAIN_TRACKER_INLINE
#undef CHAIN_TRACKER_INDEPENDENT
#undef CHAIN_TRACKER_VECTORS
