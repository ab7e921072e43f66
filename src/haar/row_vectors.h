// SPDX-License-Identifier: BSD-3-Clause
/// What the loops of row_sums.h are made of. This header is compiled once for every set of
/// instructions, so all that it defines is local to the file that includes it, and it uses no
/// template of the standard library: the linker would merge its copies.
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

namespace chain_tracker::haar {
namespace {

using U16 = std::uint16_t;
using S16 = std::int16_t;
using U32 = std::uint32_t;
using S32 = std::int32_t;

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
CHAIN_TRACKER_INLINE WideVector wide(__m256i low, __m256i high) {
  if constexpr (std::is_signed_v<Element>) {
    return {{reinterpret_cast<HalfVector>(_mm512_cvtepi16_epi32(low)),
             reinterpret_cast<HalfVector>(_mm512_cvtepi16_epi32(high))}};
  } else {
    return {{reinterpret_cast<HalfVector>(_mm512_cvtepu16_epi32(low)),
             reinterpret_cast<HalfVector>(_mm512_cvtepu16_epi32(high))}};
  }
}

template <typename Element>
CHAIN_TRACKER_INLINE WideVector wide(Register values) {
  return wide<Element>(_mm512_castsi512_si256(values), _mm512_extracti64x4_epi64(values, 1));
}

/// The same straight from memory, which spares taking a vector apart.
template <typename Element>
CHAIN_TRACKER_INLINE WideVector loadWide(const Element* from) {
  return wide<Element>(loadAs<__m256i>(from), loadAs<__m256i>(from + kHalfLanes));
}

template <Write kWrite>
CHAIN_TRACKER_INLINE void store(Register values, void* to) {
  if constexpr (kWrite == Write::kAroundCaches) {
    _mm512_stream_si512(static_cast<Register*>(to), values);
  } else {
    std::memcpy(to, &values, sizeof(values));
  }
}

template <Write kWrite>
CHAIN_TRACKER_INLINE void storeWide(const WideVector& sums, void* to) {
  store<kWrite>(reinterpret_cast<Register>(sums.halves[0]), to);
  store<kWrite>(reinterpret_cast<Register>(sums.halves[1]), static_cast<Register*>(to) + 1);
}

/// The first `count` < kLanes values only.
CHAIN_TRACKER_INLINE void storeFirst(const NarrowVector& values, void* to, int count) {
  _mm512_mask_storeu_epi16(to, (std::uint32_t{1} << count) - 1, reinterpret_cast<Register>(values));
}
CHAIN_TRACKER_INLINE void storeFirst(const WideVector& values, void* to, int count) {
  const std::uint32_t mask = (std::uint32_t{1} << count) - 1;
  _mm512_mask_storeu_epi32(to, static_cast<__mmask16>(mask),
                           reinterpret_cast<Register>(values.halves[0]));
  _mm512_mask_storeu_epi32(static_cast<Register*>(to) + 1, static_cast<__mmask16>(mask >> 16),
                           reinterpret_cast<Register>(values.halves[1]));
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

template <typename Element>
CHAIN_TRACKER_INLINE WideVector loadWide(const Element* from) {
  return wide<Element>(loadAs<Register>(from));
}

template <Write kWrite>
CHAIN_TRACKER_INLINE void store(Register values, void* to) {
  if constexpr (kWrite == Write::kAroundCaches) {
    _mm256_stream_si256(static_cast<Register*>(to), values);
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
#ifdef __AVX512BW__
  static CHAIN_TRACKER_INLINE void writeFirst(const Vector& sums, void* to, int count) {
    storeFirst(sums, to, count);
  }
#endif
};

template <typename K>
struct VectorAccess<K, 2, 2, 4> : VectorAccess<K, 2, 2, 2> {
  template <Write kWrite>
  static CHAIN_TRACKER_INLINE void write(const NarrowVector& sums, void* to) {
    storeWide<kWrite>(wide<typename K::Taken>(reinterpret_cast<Register>(sums)), to);
  }
#ifdef __AVX512BW__
  static CHAIN_TRACKER_INLINE void writeFirst(const NarrowVector& sums, void* to, int count) {
    storeFirst(wide<typename K::Taken>(reinterpret_cast<Register>(sums)), to, count);
  }
#endif
};

template <typename K>
struct VectorAccess<K, 2, 4, 4> {
  using Vector = WideVector;
  static constexpr int kElements = kLanes;
  static CHAIN_TRACKER_INLINE Vector load(const typename K::Source* from) { return loadWide(from); }
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

}  // namespace
}  // namespace chain_tracker::haar
