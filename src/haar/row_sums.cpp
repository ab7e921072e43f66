// SPDX-License-Identifier: BSD-3-Clause
#include "row_sums.h"

#include <algorithm>
#include <cstring>

#include "chain_tracker/image/multiversion.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#if defined(__GNUC__)
#define CHAIN_TRACKER_INLINE inline __attribute__((always_inline))
#else
#define CHAIN_TRACKER_INLINE inline
#endif

namespace chain_tracker::haar {
namespace {

/// Elements that are worked on in the nearest cache before they are written.
constexpr int kBlock = 128;

/// One kind of row sum: types of the source's elements, of the sum (unsigned: it wraps around), of
/// what the sum is taken as, and of the target.
template <typename SourceType, typename SumType, typename TakenType, typename TargetType>
struct Kind {
  using Source = SourceType;
  using Sum = SumType;
  using Taken = TakenType;
  using Target = TargetType;
};

template <typename K, size_t kTaps>
CHAIN_TRACKER_INLINE void sumTaps(const RowInput* inputs, int first, int count,
                                  typename K::Target* __restrict target) {
  using Sum = typename K::Sum;
  using Source = typename K::Source;
  const Source* rows[kTaps];
  Sum weights[kTaps];
  for (size_t k = 0; k < kTaps; ++k) {
    rows[k] = static_cast<const Source*>(inputs[k].row) + first;
    weights[k] = static_cast<Sum>(inputs[k].weight);
  }
  for (int x = 0; x < count; ++x) {
    Sum sum = 0;
    for (size_t k = 0; k < kTaps; ++k) {
      sum = static_cast<Sum>(sum + static_cast<Sum>(rows[k][x]) * std::uint32_t{weights[k]});
    }
    target[x] = static_cast<typename K::Target>(static_cast<typename K::Taken>(sum));
  }
}

/// Any number of taps: four at a time, on a block of sums.
template <typename K>
CHAIN_TRACKER_INLINE void sumManyTaps(const RowInput* inputs, size_t taps, int first, int count,
                                      typename K::Target* __restrict target) {
  using Sum = typename K::Sum;
  using SumKind = Kind<typename K::Source, Sum, Sum, Sum>;
  constexpr size_t kGroup = 4;
  alignas(64) Sum sums[kBlock];
  alignas(64) Sum group[kBlock];
  for (int start = 0; start < count; start += kBlock) {
    const int length = std::min(kBlock, count - start);
    std::fill(sums, sums + kBlock, Sum{0});
    for (size_t k = 0; k < taps; k += kGroup) {
      if (k + kGroup <= taps) {
        sumTaps<SumKind, kGroup>(inputs + k, first + start, length, group);
      } else {
        sumTaps<SumKind, 1>(inputs + k, first + start, length, group);
        k -= kGroup - 1;
      }
      for (int x = 0; x < kBlock; ++x) sums[x] = static_cast<Sum>(sums[x] + group[x]);
    }
    for (int x = 0; x < length; ++x) {
      target[start + x] = static_cast<typename K::Target>(static_cast<typename K::Taken>(sums[x]));
    }
  }
}

template <typename K>
CHAIN_TRACKER_INLINE void sumAs(const RowInput* inputs, size_t taps, int first, int count,
                                typename K::Target* target) {
  switch (taps) {
    // clang-format off
    case 1: return sumTaps<K, 1>(inputs, first, count, target);
    case 2: return sumTaps<K, 2>(inputs, first, count, target);
    case 3: return sumTaps<K, 3>(inputs, first, count, target);
    case 4: return sumTaps<K, 4>(inputs, first, count, target);
    case 5: return sumTaps<K, 5>(inputs, first, count, target);
    case 6: return sumTaps<K, 6>(inputs, first, count, target);
    case 7: return sumTaps<K, 7>(inputs, first, count, target);
    case 8: return sumTaps<K, 8>(inputs, first, count, target);
    case 9: return sumTaps<K, 9>(inputs, first, count, target);
    case 12: return sumTaps<K, 12>(inputs, first, count, target);
    case 16: return sumTaps<K, 16>(inputs, first, count, target);
    default: return sumManyTaps<K>(inputs, taps, first, count, target);
      // clang-format on
  }
}

using U16 = std::uint16_t;
using S16 = std::int16_t;
using U32 = std::uint32_t;
using S32 = std::int32_t;

CHAIN_TRACKER_MULTIVERSION void sum16To16(const RowInput* inputs, size_t taps, int first, int count,
                                          void* target) {
  sumAs<Kind<U16, U16, U16, U16>>(inputs, taps, first, count, static_cast<U16*>(target));
}
CHAIN_TRACKER_MULTIVERSION void sum16To32Signed(const RowInput* inputs, size_t taps, int first,
                                                int count, void* target) {
  sumAs<Kind<U16, U16, S16, S32>>(inputs, taps, first, count, static_cast<S32*>(target));
}
CHAIN_TRACKER_MULTIVERSION void sum16To32Unsigned(const RowInput* inputs, size_t taps, int first,
                                                  int count, void* target) {
  sumAs<Kind<U16, U16, U16, S32>>(inputs, taps, first, count, static_cast<S32*>(target));
}
CHAIN_TRACKER_MULTIVERSION void sumSigned16To32(const RowInput* inputs, size_t taps, int first,
                                                int count, void* target) {
  sumAs<Kind<S16, U32, S32, S32>>(inputs, taps, first, count, static_cast<S32*>(target));
}
CHAIN_TRACKER_MULTIVERSION void sumUnsigned16To32(const RowInput* inputs, size_t taps, int first,
                                                  int count, void* target) {
  sumAs<Kind<U16, U32, S32, S32>>(inputs, taps, first, count, static_cast<S32*>(target));
}
CHAIN_TRACKER_MULTIVERSION void sum32To32(const RowInput* inputs, size_t taps, int first, int count,
                                          void* target) {
  sumAs<Kind<U32, U32, S32, S32>>(inputs, taps, first, count, static_cast<S32*>(target));
}

/// `to` is aligned to 16 bytes.
void copyAroundCaches(const S32* from, S32* to, int count) {
#ifdef __SSE2__
  constexpr int kLanes = 4;
  int x = 0;
  for (; x + kLanes <= count; x += kLanes) {
    __m128i values;
    std::memcpy(&values, from + x, sizeof(values));
    _mm_stream_si128(reinterpret_cast<__m128i*>(to + x), values);
  }
  for (; x < count; ++x) to[x] = from[x];
#else
  std::copy(from, from + count, to);
#endif
}

#ifdef __SSE2__
constexpr int kPixels = 8;

/// Adds `before` and 8 running sums of 16 bits to what is above.
void addRunningSums(const U16* above, __m128i sums, U16 before, U16* integral) {
  __m128i values;
  std::memcpy(&values, above, sizeof(values));
  values = _mm_add_epi16(values, _mm_add_epi16(sums, _mm_set1_epi16(static_cast<S16>(before))));
  std::memcpy(integral, &values, sizeof(values));
}

void addRunningSums(const U32* above, __m128i sums, U32 before, U32* integral) {
  const __m128i start = _mm_set1_epi32(static_cast<S32>(before));
  const __m128i halves[] = {_mm_unpacklo_epi16(sums, _mm_setzero_si128()),
                            _mm_unpackhi_epi16(sums, _mm_setzero_si128())};
  for (int i = 0; i < 2; ++i) {
    __m128i values;
    std::memcpy(&values, above + 4 * i, sizeof(values));
    values = _mm_add_epi32(values, _mm_add_epi32(halves[i], start));
    std::memcpy(integral + 4 * i, &values, sizeof(values));
  }
}
#endif

/// `Sum` wraps around.
template <typename Sum>
void integrate(const std::uint8_t* pixels, const Sum* above, Sum* integral, int count) {
  Sum before = 0;
  int x = 0;
#ifdef __SSE2__
  for (; x + kPixels <= count; x += kPixels) {
    const __m128i bytes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(pixels + x));
    __m128i sums = _mm_unpacklo_epi8(bytes, _mm_setzero_si128());
    sums = _mm_add_epi16(sums, _mm_slli_si128(sums, 2));
    sums = _mm_add_epi16(sums, _mm_slli_si128(sums, 4));
    sums = _mm_add_epi16(sums, _mm_slli_si128(sums, 8));
    addRunningSums(above + x, sums, before, integral + x);
    before = static_cast<Sum>(before + static_cast<U16>(_mm_extract_epi16(sums, kPixels - 1)));
  }
#endif
  for (; x < count; ++x) {
    before = static_cast<Sum>(before + pixels[x]);
    integral[x] = static_cast<Sum>(above[x] + before);
  }
}

}  // namespace

void sumRows(const RowSum& sum, const RowInput* inputs, size_t input_count, void* target,
             int count) {
  constexpr decltype(&sum32To32) kSums[] = {sum16To16,       sum16To32Signed,   sum16To32Unsigned,
                                            sumSigned16To32, sumUnsigned16To32, sum32To32};
  const auto sum_taps = kSums[static_cast<size_t>(sum.kind)];
  if (!sum.streaming) {
    sum_taps(inputs, input_count, 0, count, target);
    return;
  }
  alignas(64) S32 block[kBlock];
  for (int x = 0; x < count; x += kBlock) {
    const int length = std::min(kBlock, count - x);
    sum_taps(inputs, input_count, x, length, block);
    copyAroundCaches(block, static_cast<S32*>(target) + x, length);
  }
}

void integrateRow(const std::uint8_t* pixels, const std::uint16_t* above, std::uint16_t* integral,
                  int count) {
  integrate(pixels, above, integral, count);
}
void integrateRow(const std::uint8_t* pixels, const std::uint32_t* above, std::uint32_t* integral,
                  int count) {
  integrate(pixels, above, integral, count);
}

CHAIN_TRACKER_MULTIVERSION void narrowRow(const std::uint32_t* __restrict wide,
                                          std::uint16_t* __restrict narrow, int count) {
  for (int x = 0; x < count; ++x) narrow[x] = static_cast<std::uint16_t>(wide[x]);
}

}  // namespace chain_tracker::haar
