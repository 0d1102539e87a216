#pragma once
#include <cmath>
#include <span>

#include "limpid/core/number.h"
#include "limpid/core/scene.h"

namespace limpid {

/// Height of the waves over the calm plane and its slopes along PlaneAxes.
struct WaveHeight {
  double height = 0, slope_x = 0, slope_y = 0;
};

/// Slopes of the surface along PlaneAxes.
template <class F>
struct Slopes {
  F x, y;
};

/// The part of a wave's phase that is equal everywhere at the time t. Exact for any t: omega t is
/// reduced in double first.
inline double wave_offset(const SineWave& wave, double t) {
  return wave.phase - std::fmod(wave.omega * t, 2 * M_PI);
}

/// Phase at the plane coordinates x, y; `offset` is wave_offset.
template <class F>
LIMPID_INLINE F wave_phase(const SineWave& wave, F x, F y, F offset) {
  return F(wave.k_x) * x + F(wave.k_y) * y + offset;
}

/// Slopes of one sine wave, amplitude k cos(phase).
template <class F>
LIMPID_INLINE Slopes<F> sine_slopes(const SineWave& wave, F phase) {
  const F cosine = cos(phase);
  return {F(wave.amplitude * wave.k_x) * cosine, F(wave.amplitude * wave.k_y) * cosine};
}

/// Sum of sine waves at the plane coordinates x, y and the time t.
inline WaveHeight wave_height(std::span<const SineWave> waves, double x, double y, double t) {
  WaveHeight sum;
  for (const SineWave& w : waves) {
    const double phase = wave_phase(w, x, y, wave_offset(w, t));
    const Slopes<double> slopes = sine_slopes(w, phase);
    sum.height += w.amplitude * sin(phase);
    sum.slope_x += slopes.x;
    sum.slope_y += slopes.y;
  }
  return sum;
}

}  // namespace limpid
