#pragma once
#include "core/lanes.h"

/// Texels at places that differ from lane to lane, by one index for each lane: a vector, or Places.
/// For inclusion by the *_target.cpp files alone.
///
/// Lanes are loaded one by one, and two neighbours at once for bilinear filtering. Indices leave a
/// vector two at a time. On Zen 5 this takes 0.6 of the time of the gather instruction, or of
/// indices that are written to memory just before.

namespace limpid::HWY_NAMESPACE {

/// Indices in memory, for lookups that are found some time before they are made.
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

struct TwoPlaces {
  std::int64_t first, second;
};

/// Four neighbouring lanes.
struct FourInMemory {
  const std::int32_t* at;
  LIMPID_LANES_INLINE TwoPlaces first_two() const { return {at[0], at[1]}; }
  LIMPID_LANES_INLINE TwoPlaces last_two() const { return {at[2], at[3]}; }
};
struct FourInRegister {
  __m128i at;
  LIMPID_LANES_INLINE TwoPlaces first_two() const { return parted(_mm_cvtsi128_si64(at)); }
  LIMPID_LANES_INLINE TwoPlaces last_two() const { return parted(_mm_extract_epi64(at, 1)); }

 private:
  static LIMPID_LANES_INLINE TwoPlaces parted(std::int64_t both) {
    return {static_cast<std::int32_t>(both), both >> 32};
  }
};

/// The lanes from 4 k on.
template <int k>
LIMPID_LANES_INLINE FourInMemory four_of(const Places& places) {
  return {places.at + 4 * k};
}
template <int k>
LIMPID_LANES_INLINE FourInRegister four_of(VI at) {
#if HWY_TARGET == HWY_AVX3
  return {_mm512_extracti32x4_epi32(at.raw, k)};
#elif HWY_TARGET == HWY_AVX2
  return {_mm256_extracti128_si256(at.raw, k)};
#else
  return {at.raw};
#endif
}

/// part(four lanes), joined from all lanes.
template <class At, class Part>
LIMPID_LANES_INLINE V joined(const At& at, Part&& part) {
#if HWY_TARGET == HWY_AVX3
  const __m256 low =
      _mm256_insertf128_ps(_mm256_castps128_ps256(part(four_of<0>(at))), part(four_of<1>(at)), 1);
  const __m256 high =
      _mm256_insertf128_ps(_mm256_castps128_ps256(part(four_of<2>(at))), part(four_of<3>(at)), 1);
  return V{_mm512_castpd_ps(_mm512_insertf64x4(_mm512_castps_pd(_mm512_castps256_ps512(low)),
                                               _mm256_castps_pd(high), 1))};
#elif HWY_TARGET == HWY_AVX2
  return V{
      _mm256_insertf128_ps(_mm256_castps128_ps256(part(four_of<0>(at))), part(four_of<1>(at)), 1)};
#else
  return V{part(four_of<0>(at))};
#endif
}

LIMPID_LANES_INLINE __m128 load_two_pairs(const float* data, TwoPlaces at) {
  // Unaligned loads, which those of a double would not be.
  const __m128i first = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(data + at.first));
  return _mm_loadh_pi(_mm_castsi128_ps(first), reinterpret_cast<const __m64*>(data + at.second));
}

template <class At>
LIMPID_LANES_INLINE Lane fetch(const float* data, const At& at) {
  return Lane(joined(at, [&](auto four) {
    const TwoPlaces ab = four.first_two(), cd = four.last_two();
    const __m128 a = _mm_load_ss(data + ab.first), b = _mm_load_ss(data + ab.second);
    const __m128 c = _mm_load_ss(data + cd.first), d = _mm_load_ss(data + cd.second);
    return _mm_movelh_ps(_mm_unpacklo_ps(a, b), _mm_unpacklo_ps(c, d));
  }));
}

template <class At>
LIMPID_LANES_INLINE Pair fetch_pairs(const float* data, const At& at) {
  const V a = joined(at, [&](auto four) { return load_two_pairs(data, four.first_two()); });
  const V b = joined(at, [&](auto four) { return load_two_pairs(data, four.last_two()); });
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

LIMPID_LANES_INLINE VI in_vector(const Places& places) { return hn::Load(kDI, places.at); }
LIMPID_LANES_INLINE VI in_vector(VI at) { return at; }

template <class At>
LIMPID_LANES_INLINE Lane fetch(const float* data, const At& at) {
  return Lane(hn::GatherIndex(kD, data, in_vector(at)));
}

template <class At>
LIMPID_LANES_INLINE Pair fetch_pairs(const float* data, const At& at) {
  return {fetch(data, at), fetch(data + 1, at)};
}

#endif

}  // namespace limpid::HWY_NAMESPACE
