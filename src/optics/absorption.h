#pragma once
#include <numbers>

#include "limpid/core/vec.h"

/// @file
/// Light along a path through water. `path` is its length, 0 ... +inf; `rate` and `attenuation` are
/// the losses per length, >= 0. path = +inf counts as the largest finite number, so that water
/// without loss stays clear at the sky.

namespace limpid {

/// Share that arrives after `path`: exp(-attenuation path) for each channel. Bouguer 1729, "Essai
/// d'optique". Exact for one wavelength only: a channel is a band, whose light reddens no further
/// once its most absorbed part is gone, so long paths come out too dark in red.
template <class F>
LIMPID_INLINE Rgb<F> transmittance(F path, Rgb<F> attenuation) {
  const F finite = F(0) - min(path, F(3e38));
  return {exp(finite * attenuation.r), exp(finite * attenuation.g), exp(finite * attenuation.b)};
}

/// 1/tau - 1/(exp(tau) - 1), where that difference cancels: tau in 0 ... 1. Error below 1e-9
/// in double.
template <class F>
LIMPID_INLINE F thin_share(F tau) {
  const F square = tau * tau;
  F series(-1.0 / 47900160);
  for (const double next : {1.0 / 1209600, -1.0 / 30240, 1.0 / 720, -1.0 / 12}) {
    series = F(next) + square * series;
  }
  return F(0.5) + tau * series;
}

/// Light collected along the path if each length sends 1 and light from s is dimmed by exp(-rate
/// s): (1 - exp(-rate path)) / rate. `path` itself at rate 0 (3e38 at most), 1 / rate for a long
/// path. Below tau = rate path = 1, where the difference cancels, it is path / (1 + tau (1 -
/// far_share)). Relative error below 1e-6 in float, 1e-9 in double. `left` is exp(-rate path), for
/// callers that have it already.
template <class F>
LIMPID_INLINE F column_light(F rate, F path, F left) {
  const F finite = min(path, F(3e38));
  const F tau = rate * finite;
  const auto thin = tau < F(1);
  const F light = select(thin, finite, F(1) - left);
  return light / select(thin, F(1) + tau * (F(1) - thin_share(tau)), rate);
}
template <class F>
LIMPID_INLINE F column_light(F rate, F path) {
  return column_light(rate, path, exp(F(0) - rate * min(path, F(3e38))));
}

/// Mean place at which the collected light was scattered, as a share of `path`: 1/tau - 1/(exp(tau)
/// - 1) with tau = rate path. 1/2 in clear water, falls to 1/tau in dense water. A series below tau
/// = 1, where the difference cancels: relative error below 1e-6 in float, 1e-8 in double. `left` is
/// exp(-rate path).
template <class F>
LIMPID_INLINE F far_share(F rate, F path, F left) {
  const F tau = rate * min(path, F(3e38));
  const auto thin = tau < F(1);
  // Against inf 0; the light is 0 long before tau = 1e4.
  const F gone = F(1) - left, dense = (gone - min(tau, F(1e4)) * left) / (tau * gone);
  return select(thin, thin_share(tau), dense);
}
template <class F>
LIMPID_INLINE F far_share(F rate, F path) {
  return far_share(rate, path, exp(F(0) - rate * min(path, F(3e38))));
}

/// Phase function: share of scattered light that goes in a direction, in 1/sr; its integral over
/// the sphere is 1. `cosine` is that of the scattering angle (1 is straight on), `g` its mean,
/// -0.99 ... 0.99: 0 scatters evenly, ocean water has about 0.9. Henyey & Greenstein 1941, "Diffuse
/// Radiation in the Galaxy". Real water with the same mean scatters more light back.
template <class F>
LIMPID_INLINE F henyey_greenstein(F cosine, F g) {
  const F size = abs(g);
  const F away = max(F(1) - select(g < F(0), F(0) - cosine, cosine), F(0));
  // 1 + g^2 - 2 g cosine, without its cancellation near the peak.
  const F square = (F(1) - size) * (F(1) - size) + F(2) * size * away;
  return F(0.25 / std::numbers::pi) * (F(1) - size) * (F(1) + size) / (square * sqrt(square));
}

}  // namespace limpid
