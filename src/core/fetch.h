#pragma once
#include "core/lanes.h"

/// Texels at places that differ from lane to lane. For inclusion by the *_target.cpp files alone.
///
/// Lanes are loaded one by one: on Zen 4 this takes half the time of the gather instruction, and
/// two neighbours at once, for bilinear filtering, a third of two gathers.

namespace limpid::HWY_NAMESPACE {

/// One index per lane, in memory.
struct Places {
  alignas(64) std::int32_t at[kLanes];
  Places() = default;
  LIMPID_LANES_INLINE explicit Places(VI index) { hn::Store(index, kDI, at); }
};

/// The values at a place and right after it.
struct Pair {
  Lane left, right;
};

#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_SSE4

LIMPID_LANES_INLINE __m128 load_four(const float* data, const std::int32_t* at) {
  const __m128 a = _mm_load_ss(data + at[0]), b = _mm_load_ss(data + at[1]);
  const __m128 c = _mm_load_ss(data + at[2]), d = _mm_load_ss(data + at[3]);
  return _mm_movelh_ps(_mm_unpacklo_ps(a, b), _mm_unpacklo_ps(c, d));
}

LIMPID_LANES_INLINE __m128 load_two_pairs(const float* data, const std::int32_t* at) {
  // Unaligned loads, which those of a double would not be.
  const __m128i first = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(data + at[0]));
  return _mm_loadh_pi(_mm_castsi128_ps(first), reinterpret_cast<const __m64*>(data + at[1]));
}

/// One 128-bit part from each four lanes.
template <class Part>
LIMPID_LANES_INLINE V joined(Part&& part) {
#if HWY_TARGET == HWY_AVX3
  const __m256 low = _mm256_insertf128_ps(_mm256_castps128_ps256(part(0)), part(4), 1);
  const __m256 high = _mm256_insertf128_ps(_mm256_castps128_ps256(part(8)), part(12), 1);
  return V{_mm512_castpd_ps(_mm512_insertf64x4(_mm512_castps_pd(_mm512_castps256_ps512(low)),
                                               _mm256_castps_pd(high), 1))};
#elif HWY_TARGET == HWY_AVX2
  return V{_mm256_insertf128_ps(_mm256_castps128_ps256(part(0)), part(4), 1)};
#else
  return V{part(0)};
#endif
}

LIMPID_LANES_INLINE Lane fetch(const float* data, const Places& places) {
  return Lane(joined([&](int k) { return load_four(data, places.at + k); }));
}

LIMPID_LANES_INLINE Pair fetch_pairs(const float* data, const Places& places) {
  const V a = joined([&](int k) { return load_two_pairs(data, places.at + k); });
  const V b = joined([&](int k) { return load_two_pairs(data, places.at + k + 2); });
#if HWY_TARGET == HWY_AVX3
  return {Lane(V{_mm512_shuffle_ps(a.raw, b.raw, 0x88)}),
          Lane(V{_mm512_shuffle_ps(a.raw, b.raw, 0xdd)})};
#elif HWY_TARGET == HWY_AVX2
  return {Lane(V{_mm256_shuffle_ps(a.raw, b.raw, 0x88)}),
          Lane(V{_mm256_shuffle_ps(a.raw, b.raw, 0xdd)})};
#else
  return {Lane(V{_mm_shuffle_ps(a.raw, b.raw, 0x88)}), Lane(V{_mm_shuffle_ps(a.raw, b.raw, 0xdd)})};
#endif
}

#else

LIMPID_LANES_INLINE Lane fetch(const float* data, const Places& places) {
  return Lane(hn::GatherIndex(kD, data, hn::Load(kDI, places.at)));
}

LIMPID_LANES_INLINE Pair fetch_pairs(const float* data, const Places& places) {
  return {fetch(data, places), fetch(data + 1, places)};
}

#endif

}  // namespace limpid::HWY_NAMESPACE
