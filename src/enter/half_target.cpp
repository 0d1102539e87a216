// Compiled once for each instruction set, as run/lanes_target.cpp is: sets with an instruction for
// halves use it.
#include <cfloat>
#include <cstdint>
#include <cstring>

#define IMATH_HALF_NO_LOOKUP_TABLE  // the table would have to be linked
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

#if defined(__F16C__) || HWY_TARGET == HWY_NEON
/// Converts one vector.
bool narrow_lanes(const float* floats, hwy::float16_t* halves) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::ScalableTag<float> d;
  const hn::RebindToUnsigned<decltype(d)> bits;
  const hn::Rebind<hwy::float16_t, decltype(d)> to;
  const auto value = hn::LoadU(d, floats);
  const auto narrowed = hn::DemoteTo(to, value);
  hn::StoreU(narrowed, to, halves);
  const auto again = hn::PromoteTo(d, narrowed);
  return hn::AllTrue(bits, hn::Eq(hn::BitCast(bits, again), hn::BitCast(bits, value)));
}
constexpr int kLanes = hwy::HWY_NAMESPACE::MaxLanes(hwy::HWY_NAMESPACE::ScalableTag<float>());
#else  // without that instruction Highway converts infinities and the smallest halves differently
bool narrow_lanes(const float* floats, hwy::float16_t* halves) {
  const std::uint16_t half = imath_float_to_half(*floats);
  const float again = imath_half_to_float(half);
  std::memcpy(halves, &half, sizeof half);
  return std::memcmp(&again, floats, sizeof again) == 0;
}
constexpr int kLanes = 1;
#endif

bool narrow_exactly(const float* floats, std::byte* halves, int count) {
  auto* to = reinterpret_cast<hwy::float16_t*>(halves);
  int i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    if (!narrow_lanes(floats + i, to + i)) return false;
  }
  if (i == count) return true;
  float rest[kLanes] = {};
  hwy::float16_t rest_halves[kLanes];
  std::memcpy(rest, floats + i, sizeof(float) * static_cast<std::size_t>(count - i));
  const bool exact = narrow_lanes(rest, rest_halves);
  std::memcpy(to + i, rest_halves, sizeof rest_halves[0] * static_cast<std::size_t>(count - i));
  return exact;
}

}  // namespace
}  // namespace limpid::HWY_NAMESPACE

namespace limpid {

extern const HalfTarget LIMPID_OF_TARGET(kHalf_);
const HalfTarget LIMPID_OF_TARGET(kHalf_) = {HWY_NAMESPACE::widen, HWY_NAMESPACE::narrow,
                                             HWY_NAMESPACE::narrow_exactly};

}  // namespace limpid
