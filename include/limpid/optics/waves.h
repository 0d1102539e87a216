#pragma once
#include <cmath>
#include <span>

#include <glm/vec3.hpp>

#include "limpid/core/scene.h"

namespace limpid {

/// Height of the waves over the calm plane and its slopes along PlaneAxes.
struct WaveHeight {
  double height = 0, slope_x = 0, slope_y = 0;
};

/// Sum of sines at the plane coordinates x, y and the time t. Phases stay exact for any t: omega t
/// is reduced in double before the sine.
inline WaveHeight wave_height(std::span<const SineWave> waves, double x, double y, double t) {
  WaveHeight sum;
  for (const SineWave& w : waves) {
    const double phase = w.k_x * x + w.k_y * y + w.phase - std::fmod(w.omega * t, 2 * M_PI);
    sum.height += w.amplitude * std::sin(phase);
    sum.slope_x += w.amplitude * w.k_x * std::cos(phase);
    sum.slope_y += w.amplitude * w.k_y * std::cos(phase);
  }
  return sum;
}

}  // namespace limpid
