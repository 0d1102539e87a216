#pragma once
#include "optics/absorption.h"

/// @file
/// Single scattering: sunlight that water scatters once into a view.

namespace limpid {

/// A straight path through water, away from the viewer; `begin` and `end` are depths under the calm
/// surface, >= 0, and the path descends by `sink` per unit of length (negative where it rises).
template <class F>
struct WaterPath {
  F length;  ///< 0 ... 3e38
  F sink;    ///< -1 ... 1
  F begin, end;
};

template <class F>
struct SunColumn {
  F light;      ///< length of an unattenuated path that would send as much light
  F far_share;  ///< mean place of scattering on the path: 0 its begin, 1 its end
};

/// Share of sunlight at the far end of the path relative to its near end, or the reverse where the
/// far end is brighter.
template <class F>
LIMPID_INLINE F sun_left(const WaterPath<F>& path, F rate, F down) {
  return exp(F(0) - abs(rate + down * path.sink) * path.length);
}

/// Light collected along the path if at depth z each length sends exp(-down z), `down` being the
/// loss of sunlight per unit of depth, and `rate` is lost per length on the path to the viewer: the
/// integral over s of exp(-down (begin + sink s) - rate s). Where the light gets brighter faster
/// than the view loses it (towards the surface, seen from below) the integral runs from the other
/// end. `left` is sun_left(), for callers that have it already.
template <class F>
LIMPID_INLINE SunColumn<F> sun_column(const WaterPath<F>& path, F rate, F down, F left) {
  const F total = rate + down * path.sink;
  const auto brightens = total < F(0);
  const F first = select(brightens, rate * path.length + down * path.end, down * path.begin);
  const F share = far_share(abs(total), path.length, left);
  F light = column_light(abs(total), path.length, left);
  // A path from the air begins at depth 0, with factor 1.
  if_any(first > F(0), [&] { light = exp(F(0) - first) * light; });
  return {light, select(brightens, F(1) - share, share)};
}
template <class F>
LIMPID_INLINE SunColumn<F> sun_column(const WaterPath<F>& path, F rate, F down) {
  return sun_column(path, rate, down, sun_left(path, rate, down));
}

}  // namespace limpid
