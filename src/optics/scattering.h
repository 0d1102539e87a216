#pragma once
#include "optics/absorption.h"

/// @file
/// Sunlight that water scatters into a view, once.

namespace limpid {

/// A straight way through water, away from the viewer; `begin` and `end` are depths under the calm
/// surface, >= 0, and the way gets `sink` deeper a length (negative where it rises).
template <class F>
struct Way {
  F length;  ///< 0 ... 3e38
  F sink;    ///< -1 ... 1
  F begin, end;
};

template <class F>
struct SunColumn {
  F light;      ///< length of unattenuated way that would send as much
  F far_share;  ///< where on the way it was scattered on average: 0 its begin, 1 its end
};

/// What is left of sunlight from the far end of the way beside that of its near end, or the other
/// way round where that is brighter.
template <class F>
LIMPID_INLINE F sun_left(const Way<F>& way, F rate, F down) {
  return exp(F(0) - abs(rate + down * way.sink) * way.length);
}

/// Light collected along the way when at depth z each length gives exp(-down z), `down` being the
/// loss of sunlight for each depth, and on the way to the viewer `rate` is lost for each length:
/// the integral over s of exp(-down (begin + sink s) - rate s). Where it gets brighter faster than
/// the view loses it (towards the surface, seen from below) the integral runs from the other end.
/// `left` is sun_left(), for those who have it already.
template <class F>
LIMPID_INLINE SunColumn<F> sun_column(const Way<F>& way, F rate, F down, F left) {
  const F total = rate + down * way.sink;
  const auto brightens = total < F(0);
  const F first = select(brightens, rate * way.length + down * way.end, down * way.begin);
  const F share = far_share(abs(total), way.length, left);
  F light = column_light(abs(total), way.length, left);
  // None from the air: it begins at 0.
  if_any(first > F(0), [&] { light = exp(F(0) - first) * light; });
  return {light, select(brightens, F(1) - share, share)};
}
template <class F>
LIMPID_INLINE SunColumn<F> sun_column(const Way<F>& way, F rate, F down) {
  return sun_column(way, rate, down, sun_left(way, rate, down));
}

}  // namespace limpid
