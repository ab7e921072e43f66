// SPDX-License-Identifier: BSD-3-Clause
#include "row_integral.h"

#include "machine_instructions.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#if defined(__x86_64__) && defined(__GNUC__)
#define CHAIN_TRACKER_HAS_AVX2
#include <immintrin.h>
#endif

namespace chain_tracker::haar {
namespace {

using U16 = std::uint16_t;
using U32 = std::uint32_t;

/// `Sum` wraps around.
template <typename Sum>
Sum integrateOneByOne(const std::uint8_t* pixels, const Sum* above, Sum before, Sum* integral,
                      int count) {
  for (int x = 0; x < count; ++x) {
    before = static_cast<Sum>(before + pixels[x]);
    integral[x] = static_cast<Sum>(above[x] + before);
  }
  return before;
}

#ifdef __SSE2__
constexpr int kPixels = 8;

/// Running sums of 8 pixels; exact, as 8 * 255 fits in 16 bits.
__m128i runningSums(const std::uint8_t* pixels) {
  const __m128i bytes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(pixels));
  __m128i sums = _mm_unpacklo_epi8(bytes, _mm_setzero_si128());
  sums = _mm_add_epi16(sums, _mm_slli_si128(sums, 2));
  sums = _mm_add_epi16(sums, _mm_slli_si128(sums, 4));
  return _mm_add_epi16(sums, _mm_slli_si128(sums, 8));
}

template <typename Sum>
__m128i loadVector(const Sum* from) {
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
}

template <typename Sum>
void storeVector(Sum* to, __m128i values) {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to), values);
}

/// Whole vectors of pixels; `before` becomes the sum at their end. Returns their number.
int integrateVectors(const std::uint8_t* pixels, const U16* above, U16& before, U16* integral,
                     int count) {
  __m128i carry = _mm_set1_epi16(static_cast<short>(before));
  int x = 0;
  for (; x + kPixels <= count; x += kPixels) {
    const __m128i sums = runningSums(pixels + x);
    storeVector(integral + x, _mm_add_epi16(loadVector(above + x), _mm_add_epi16(sums, carry)));
    const __m128i last = _mm_shufflehi_epi16(sums, _MM_SHUFFLE(3, 3, 3, 3));
    carry = _mm_add_epi16(carry, _mm_unpackhi_epi64(last, last));
  }
  before = static_cast<U16>(_mm_extract_epi16(carry, 0));
  return x;
}

int integrateVectors(const std::uint8_t* pixels, const U32* above, U32& before, U32* integral,
                     int count) {
  __m128i carry = _mm_set1_epi32(static_cast<int>(before));
  int x = 0;
  for (; x + kPixels <= count; x += kPixels) {
    const __m128i sums = runningSums(pixels + x);
    const __m128i low = _mm_unpacklo_epi16(sums, _mm_setzero_si128());
    const __m128i high = _mm_unpackhi_epi16(sums, _mm_setzero_si128());
    storeVector(integral + x, _mm_add_epi32(loadVector(above + x), _mm_add_epi32(low, carry)));
    storeVector(integral + x + 4,
                _mm_add_epi32(loadVector(above + x + 4), _mm_add_epi32(high, carry)));
    carry = _mm_add_epi32(carry, _mm_shuffle_epi32(high, _MM_SHUFFLE(3, 3, 3, 3)));
  }
  before = static_cast<U32>(_mm_cvtsi128_si32(carry));
  return x;
}
#endif

#ifdef CHAIN_TRACKER_HAS_AVX2
constexpr int kWidePixels = 16;

__attribute__((target("avx2"))) int integrateWideVectors(const std::uint8_t* pixels,
                                                         const U16* above, U16& before,
                                                         U16* integral, int count) {
  __m256i carry = _mm256_set1_epi16(static_cast<short>(before));
  int x = 0;
  for (; x + kWidePixels <= count; x += kWidePixels) {
    const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(pixels + x));
    __m256i sums = _mm256_cvtepu8_epi16(bytes);
    sums = _mm256_add_epi16(sums, _mm256_slli_si256(sums, 2));
    sums = _mm256_add_epi16(sums, _mm256_slli_si256(sums, 4));
    sums = _mm256_add_epi16(sums, _mm256_slli_si256(sums, 8));
    // The last sum of each half, everywhere in that half.
    const __m256i last = _mm256_shuffle_epi8(sums, _mm256_set1_epi16(0x0F0E));
    const __m256i low = _mm256_permute2x128_si256(last, last, 0x08);
    const __m256i all = _mm256_add_epi16(last, _mm256_permute2x128_si256(last, last, 0x01));
    sums = _mm256_add_epi16(_mm256_add_epi16(sums, low), carry);
    const __m256i up = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(above + x));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(integral + x), _mm256_add_epi16(up, sums));
    carry = _mm256_add_epi16(carry, all);
  }
  before = static_cast<U16>(_mm256_extract_epi16(carry, 0));
  return x;
}
#endif

template <typename Sum>
Sum integrate(const std::uint8_t* pixels, const Sum* above, Sum before, Sum* integral, int start,
              int count) {
  int x = start;
#ifdef __SSE2__
  x += integrateVectors(pixels + x, above + x, before, integral + x, count - x);
#endif
  return integrateOneByOne(pixels + x, above + x, before, integral + x, count - x);
}

}  // namespace

U16 integrateRow(const std::uint8_t* pixels, const U16* above, U16 before, U16* integral, int count,
                 InstructionSet instructions) {
  int start = 0;
#ifdef CHAIN_TRACKER_HAS_AVX2
  if (canUseAvx2(instructions)) {
    start = integrateWideVectors(pixels, above, before, integral, count);
  }
#else
  static_cast<void>(instructions);
#endif
  return integrate(pixels, above, before, integral, start, count);
}

U32 integrateRow(const std::uint8_t* pixels, const U32* above, U32 before, U32* integral, int count,
                 InstructionSet) {
  return integrate(pixels, above, before, integral, 0, count);
}

}  // namespace chain_tracker::haar
