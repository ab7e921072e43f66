// SPDX-License-Identifier: BSD-3-Clause
#include "row_sums.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#if defined(__x86_64__) && defined(__GNUC__)
#define CHAIN_TRACKER_HAS_AVX2
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

/// Elements that are worked on in the nearest cache before they are written.
constexpr int kPiece = 128;
constexpr int kStreamedPiece = 512;

/// One kind of row sum: types of the source's elements, of the sum (unsigned: it wraps around), of
/// what the sum is taken as, and of the target.
template <typename SourceType, typename SumType, typename TakenType, typename TargetType>
struct Kind {
  using Source = SourceType;
  using Sum = SumType;
  using Taken = TakenType;
  using Target = TargetType;
};

/// Taps of weight 1, of weight -1, and others, in that order.
template <int kPlus, int kMinus, int kOther>
struct TapCounts {
  static constexpr int kTaps = kPlus + kMinus + kOther;
};

template <typename K, int kPlus, int kMinus, int kOther>
CHAIN_TRACKER_INLINE void sumTaps(TapCounts<kPlus, kMinus, kOther>, const void* const* sources,
                                  const std::int32_t* source_weights, size_t,
                                  typename K::Target* __restrict target, const RowBlock& block) {
  using Sum = typename K::Sum;
  using Source = typename K::Source;
  constexpr int kTaps = kPlus + kMinus + kOther;
  const int rows = block.rows;
  const int columns = block.columns;
  const std::ptrdiff_t source_stride = block.source_stride;
  const std::ptrdiff_t target_stride = block.target_stride;
  const Source* from[kTaps];
  Sum weights[kTaps];
  for (int k = 0; k < kTaps; ++k) {
    from[k] = static_cast<const Source*>(sources[k]);
    weights[k] = static_cast<Sum>(source_weights[k]);
  }
  for (int y = 0; y < rows; ++y) {
    CHAIN_TRACKER_INDEPENDENT
    for (int x = 0; x < columns; ++x) {
      Sum sum = 0;
      for (int k = 0; k < kPlus; ++k) sum = static_cast<Sum>(sum + static_cast<Sum>(from[k][x]));
      for (int k = kPlus; k < kPlus + kMinus; ++k) {
        sum = static_cast<Sum>(sum - static_cast<Sum>(from[k][x]));
      }
      for (int k = kPlus + kMinus; k < kTaps; ++k) {
        sum = static_cast<Sum>(sum + static_cast<Sum>(from[k][x]) * std::uint32_t{weights[k]});
      }
      target[x] = static_cast<typename K::Target>(static_cast<typename K::Taken>(sum));
    }
    for (int k = 0; k < kTaps; ++k) from[k] += source_stride;
    target += target_stride;
  }
}

struct AnyTaps {};

/// Any number of taps: four at a time, on a piece of a row.
template <typename K>
CHAIN_TRACKER_INLINE void sumTaps(AnyTaps, const void* const* sources, const std::int32_t* weights,
                                  size_t taps, typename K::Target* __restrict target,
                                  const RowBlock& block) {
  using Sum = typename K::Sum;
  using Source = typename K::Source;
  using SumKind = Kind<Source, Sum, Sum, Sum>;
  constexpr size_t kGroup = 4;
  alignas(64) Sum sums[kPiece];
  alignas(64) Sum group[kPiece];
  for (int y = 0; y < block.rows; ++y) {
    for (int start = 0; start < block.columns; start += kPiece) {
      const int length = std::min(kPiece, block.columns - start);
      std::fill(sums, sums + kPiece, Sum{0});
      for (size_t k = 0; k < taps;) {
        const bool is_full = k + kGroup <= taps;
        const void* from[kGroup];
        for (size_t i = 0; i < (is_full ? kGroup : 1); ++i) {
          from[i] = static_cast<const Source*>(sources[k + i]) + y * block.source_stride + start;
        }
        const RowBlock piece{1, length, 0, 0};
        if (is_full) {
          sumTaps<SumKind>(TapCounts<0, 0, kGroup>(), from, weights + k, kGroup, group, piece);
        } else {
          sumTaps<SumKind>(TapCounts<0, 0, 1>(), from, weights + k, 1, group, piece);
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

/// The same loops compiled for the machine's least set of instructions and for a wide one.
struct Portable {
  template <typename K, typename Taps>
  static void sum(const void* const* sources, const std::int32_t* weights, size_t taps,
                  void* target, const RowBlock& block) {
    sumTaps<K>(Taps(), sources, weights, taps, static_cast<typename K::Target*>(target), block);
  }
};

#ifdef CHAIN_TRACKER_HAS_AVX2
struct Avx2 {
  template <typename K, typename Taps>
  __attribute__((target("avx2"))) static void sum(const void* const* sources,
                                                  const std::int32_t* weights, size_t taps,
                                                  void* target, const RowBlock& block) {
    sumTaps<K>(Taps(), sources, weights, taps, static_cast<typename K::Target*>(target), block);
  }
};
#endif

/// The loop for these numbers of taps of weight 1, weight -1 and others.
template <typename Machine, typename K>
RowSum::Function chooseLoop(size_t plus, size_t minus, size_t other) {
  switch (plus * 10000 + minus * 100 + other) {
    // clang-format off
    case 1: return Machine::template sum<K, TapCounts<0, 0, 1>>;
    case 2: return Machine::template sum<K, TapCounts<0, 0, 2>>;
    case 10000: return Machine::template sum<K, TapCounts<1, 0, 0>>;
    case 10001: return Machine::template sum<K, TapCounts<1, 0, 1>>;
    case 10100: return Machine::template sum<K, TapCounts<1, 1, 0>>;
    case 10102: return Machine::template sum<K, TapCounts<1, 1, 2>>;
    case 100: return Machine::template sum<K, TapCounts<0, 1, 0>>;
    case 20000: return Machine::template sum<K, TapCounts<2, 0, 0>>;
    case 20001: return Machine::template sum<K, TapCounts<2, 0, 1>>;
    case 201: return Machine::template sum<K, TapCounts<0, 2, 1>>;
    case 20100: return Machine::template sum<K, TapCounts<2, 1, 0>>;
    case 10200: return Machine::template sum<K, TapCounts<1, 2, 0>>;
    case 30000: return Machine::template sum<K, TapCounts<3, 0, 0>>;
    case 20200: return Machine::template sum<K, TapCounts<2, 2, 0>>;
    case 20202: return Machine::template sum<K, TapCounts<2, 2, 2>>;
    case 20204: return Machine::template sum<K, TapCounts<2, 2, 4>>;
    case 30300: return Machine::template sum<K, TapCounts<3, 3, 0>>;
    case 40005: return Machine::template sum<K, TapCounts<4, 0, 5>>;
    case 40400: return Machine::template sum<K, TapCounts<4, 4, 0>>;
    case 80800: return Machine::template sum<K, TapCounts<8, 8, 0>>;
    default: break;
      // clang-format on
  }
  switch (plus + minus + other) {
    // clang-format off
    case 3: return Machine::template sum<K, TapCounts<0, 0, 3>>;
    case 4: return Machine::template sum<K, TapCounts<0, 0, 4>>;
    case 5: return Machine::template sum<K, TapCounts<0, 0, 5>>;
    case 6: return Machine::template sum<K, TapCounts<0, 0, 6>>;
    case 7: return Machine::template sum<K, TapCounts<0, 0, 7>>;
    case 8: return Machine::template sum<K, TapCounts<0, 0, 8>>;
    case 9: return Machine::template sum<K, TapCounts<0, 0, 9>>;
    case 10: return Machine::template sum<K, TapCounts<0, 0, 10>>;
    case 12: return Machine::template sum<K, TapCounts<0, 0, 12>>;
    case 16: return Machine::template sum<K, TapCounts<0, 0, 16>>;
    default: return Machine::template sum<K, AnyTaps>;
      // clang-format on
  }
}

using U16 = std::uint16_t;
using S16 = std::int16_t;
using U32 = std::uint32_t;
using S32 = std::int32_t;

template <typename Machine>
RowSum::Function chooseLoop(RowKind kind, size_t plus, size_t minus, size_t other) {
  switch (kind) {
    case RowKind::k16To16:
      return chooseLoop<Machine, Kind<U16, U16, U16, U16>>(plus, minus, other);
    case RowKind::k16To32Signed:
      return chooseLoop<Machine, Kind<U16, U16, S16, S32>>(plus, minus, other);
    case RowKind::k16To32Unsigned:
      return chooseLoop<Machine, Kind<U16, U16, U16, S32>>(plus, minus, other);
    case RowKind::kSigned16To32:
      return chooseLoop<Machine, Kind<S16, U32, S32, S32>>(plus, minus, other);
    case RowKind::kUnsigned16To32:
      return chooseLoop<Machine, Kind<U16, U32, S32, S32>>(plus, minus, other);
    case RowKind::k32To32:
      break;
  }
  return chooseLoop<Machine, Kind<U32, U32, S32, S32>>(plus, minus, other);
}

RowSum::Function chooseLoop(RowKind kind, size_t plus, size_t minus, size_t other,
                            InstructionSet instructions) {
#ifdef CHAIN_TRACKER_HAS_AVX2
  const bool is_wide = instructions == InstructionSet::kBest && __builtin_cpu_supports("avx2");
  if (is_wide) return chooseLoop<Avx2>(kind, plus, minus, other);
#else
  static_cast<void>(instructions);
#endif
  return chooseLoop<Portable>(kind, plus, minus, other);
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

RowSum::RowSum(RowKind kind, const std::vector<std::int32_t>& weights, InstructionSet instructions)
    : kind_(kind) {
  const auto rank = [&](size_t i) { return weights[i] == 1 ? 0 : weights[i] == -1 ? 1 : 2; };
  for (const int wanted : {0, 1, 2}) {
    for (size_t i = 0; i < weights.size(); ++i) {
      if (rank(i) == wanted) order_.push_back(i);
    }
  }
  for (const size_t i : order_) weights_.push_back(weights[i]);
  const auto count = [&](int wanted) {
    return static_cast<size_t>(
        std::count_if(order_.begin(), order_.end(), [&](size_t i) { return rank(i) == wanted; }));
  };
  sum_ = chooseLoop(kind, count(0), count(1), count(2), instructions);
}

void RowSum::runStreaming(const void* const* sources, std::int32_t* target,
                          const RowBlock& block) const {
  const bool is_wide = kind_ == RowKind::k32To32;
  const std::ptrdiff_t element = is_wide ? sizeof(U32) : sizeof(U16);
  alignas(64) S32 values[kStreamedPiece];
  const void* from[kMaxTaps];
  for (int y = 0; y < block.rows; ++y) {
    for (int x = 0; x < block.columns; x += kStreamedPiece) {
      const int length = std::min(kStreamedPiece, block.columns - x);
      for (size_t k = 0; k < weights_.size(); ++k) {
        from[k] = static_cast<const char*>(sources[k]) + (y * block.source_stride + x) * element;
      }
      sum_(from, weights_.data(), weights_.size(), values, {1, length, 0, 0});
      copyAroundCaches(values, target + y * block.target_stride + x, length);
    }
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

}  // namespace chain_tracker::haar
