#include "complete/edge_picture.h"

namespace limpid {
namespace {

std::uint8_t side_of(bool wet, float dry) {
  const int dry_side = static_cast<int>(dry < HUGE_VALF ? Side::kDry : Side::kNone);
  return static_cast<std::uint8_t>(wet ? static_cast<int>(Side::kWet) : dry_side);
}

}  // namespace

/// The calm surface lies in front where over / under < dry: multiplied out, to avoid the division.
void EdgePicture::sides(int y, int x0, int x1, std::uint8_t* to) const {
  const float* dry = &depth.at(x0, y);
  const std::ptrdiff_t step = depth.x_stride;
  if (surface) {
    const float* water = &surface.at(x0, y);
    if (step == 1 && surface.x_stride == 1) {
      for (int i = 0; i < x1 - x0; ++i) to[i] = side_of(water[i] < dry[i], dry[i]);
      return;
    }
    for (int x = x0; x < x1; ++x, dry += step, water += surface.x_stride) {
      *to++ = side_of(*water < *dry, *dry);
    }
    return;
  }
  const RowHeights heights(pass, y);
  const float sign = heights.over + x0 * heights.over_step > 0 ? -1.0f : 1.0f;
  const auto over = static_cast<float>(std::abs(heights.over + x0 * heights.over_step));
  const float over_step = -sign * static_cast<float>(heights.over_step);
  const float under = sign * static_cast<float>(heights.under + x0 * heights.under_step);
  const float under_step = sign * static_cast<float>(heights.under_step);
  const auto row = [&](auto stride) {
    for (int i = 0; i < x1 - x0; ++i) {
      const float z = dry[i * stride], along = static_cast<float>(i);
      to[i] = side_of(z * (under + along * under_step) > over + along * over_step, z);
    }
  };
  if (step == 1) {
    row(std::integral_constant<std::ptrdiff_t, 1>());
  } else {
    row(step);
  }
}

}  // namespace limpid
