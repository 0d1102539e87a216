#pragma once
#include <cstddef>
#include <string>

namespace limpid {

/// Half floats, a run of pixels at a time, compiled for one instruction set; strides of halves
/// count bytes. Every half is a float; floats are rounded to the nearest half (even, if two are
/// equally near), finite floats beyond the largest half to the largest, so that no finite number
/// becomes infinite; NaN and infinities are unchanged. Files have the same rule
/// (files/exr/half_bits.h).
struct HalfTarget {
  void (*widen)(const std::byte* halves, std::ptrdiff_t stride, float* floats, int count);
  void (*narrow)(const float* floats, std::byte* halves, std::ptrdiff_t stride, int count);
  /// Writes halves in a row, if halves represent all the floats exactly; returns whether they do.
  /// If not, the output is undefined.
  bool (*narrow_exactly)(const float* floats, std::byte* halves, int count);
};

/// `simd` as in FusedOptions; throws as simd_index().
const HalfTarget& half_target(const std::string& simd);

}  // namespace limpid
