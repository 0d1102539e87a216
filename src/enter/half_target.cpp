// Compiled once for each instruction set, as run/lanes_target.cpp is: those with an instruction for
// halves use it.
#include <cfloat>
#include <cstdint>
#include <cstring>

#define IMATH_HALF_NO_LOOKUP_TABLE  // which would have to be linked
#include <Imath/half.h>
#include <hwy/highway.h>

#include "core/target_name.h"
#include "enter/half.h"

namespace limpid::HWY_NAMESPACE {
namespace {

constexpr float kLargest = 65504, kLargestFloat = FLT_MAX;

void widen(const std::byte* halves, std::ptrdiff_t stride, float* floats, int count) {
  for (int i = 0; i < count; ++i) {
    std::uint16_t bits;
    std::memcpy(&bits, halves + i * stride, sizeof bits);
    floats[i] = imath_half_to_float(bits);
  }
}

void narrow(const float* floats, std::byte* halves, std::ptrdiff_t stride, int count) {
  for (int i = 0; i < count; ++i) {
    const float value = floats[i];
    const bool high = value > kLargest && value <= kLargestFloat;
    const bool low = value < -kLargest && value >= -kLargestFloat;
    const std::uint16_t bits = imath_float_to_half(high ? kLargest : low ? -kLargest : value);
    std::memcpy(halves + i * stride, &bits, sizeof bits);
  }
}

}  // namespace
}  // namespace limpid::HWY_NAMESPACE

namespace limpid {

extern const HalfTarget LIMPID_OF_TARGET(kHalf_);
const HalfTarget LIMPID_OF_TARGET(kHalf_) = {HWY_NAMESPACE::widen, HWY_NAMESPACE::narrow};

}  // namespace limpid
