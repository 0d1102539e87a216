#pragma once
#include <cstddef>
#include <string>

namespace limpid {

/// Half floats, a run of pixels at a time, as compiled for one instruction set; strides of halves
/// count bytes. Every half is a float; floats are rounded to the nearest half (even, where two are
/// as near), finite ones beyond the largest half to that one, so that no number becomes an
/// infinity; NaN and infinities stay what they are. Files have the same rule
/// (files/exr/half_bits.h).
struct HalfTarget {
  void (*widen)(const std::byte* halves, std::ptrdiff_t stride, float* floats, int count);
  void (*narrow)(const float* floats, std::byte* halves, std::ptrdiff_t stride, int count);
  /// Halves in a row, if there are some that are the very floats; returns whether. What else is
  /// written counts for nothing.
  bool (*narrow_exactly)(const float* floats, std::byte* halves, int count);
};

/// `simd` as in FusedOptions; throws as simd_index().
const HalfTarget& half_target(const std::string& simd);

}  // namespace limpid
