#pragma once
#include <cmath>

#include "limpid/core/frame.h"

#include "op/pixel.h"

/// @file
/// Bilinear lookups in which only some texels count: for refraction those below the surface, for
/// reflection the valid ones of the mirror. Objects in front never bleed in, in any channel.
///
/// A `valid(quad)` returns 1 or 0 for each of the four taps. The share of valid weight is a
/// continuous function of the place; where it is 1 the lookup is plain bilinear filtering. The
/// missing share is taken from the last valid place on the line from the pixel (the offset is
/// shortened), in proportion: so the picture has no step at a silhouette. The pixel's own texel
/// must be valid.

namespace limpid {

template <class F, class Quad>
struct ValidTaps {
  Quad there, shortened;
  Four<F> weight_there, weight_shortened;  ///< sum to 1, over both and the filled share
  F share;                                 ///< weight of `there`: 1 real, 0 replaced
  F filled;                                ///< weight of the replacement that is not in the planes
  Vec2<F> place;                           ///< the place of most of the lookup
  decltype(F() < F()) made_up;             ///< where `shortened` counts

  /// 1 up to rounding; less if even the last resort was not bearable.
  F weight() const {
    F sum = filled;
    for (int k = 0; k < 4; ++k) sum = sum + weight_there[k] + weight_shortened[k];
    return sum;
  }

  template <class Tap>
  F read(const Tap& tap, PlaneId plane) const {
    F sum = weighted(weight_there, tap.read(plane, there));
    if_any(made_up, [&] { sum = sum + weighted(weight_shortened, tap.read(plane, shortened)); });
    return sum;
  }

  /// For depths: +inf if infinite ones prevail, and no 0 x inf.
  template <class Tap>
  F read_depth(const Tap& tap, PlaneId plane) const {
    const auto finite = [](Four<F> depths) {
      for (F& depth : depths.at) depth = min(depth, F(1e30));
      return depths;
    };
    F sum = weighted(weight_there, finite(tap.read(plane, there)));
    if_any(made_up,
           [&] { sum = sum + weighted(weight_shortened, finite(tap.read(plane, shortened))); });
    return select(sum < F(1e28), sum, F(HUGE_VAL));
  }

 private:
  static LIMPID_INLINE F weighted(const Four<F>& weights, const Four<F>& values) {
    F sum = F(0);
    for (int k = 0; k < 4; ++k) sum = sum + weights[k] * values[k];
    return sum;
  }
};

/// Valid share of the weight at `shift`.
template <class F, class Tap, class Valid>
F valid_share(const Tap& tap, Vec2<F> shift, Valid&& valid) {
  const auto quad = tap.quad(shift);
  const Four<F> counts = valid(quad);
  F share = F(0);
  for (int k = 0; k < 4; ++k) share = share + quad.weight(k) * counts[k];
  return share;
}

/// The largest share of `shift` at which half of the weight is valid: searched from the far end in
/// steps of an eighth, then by bisection, then by a secant, so that it moves smoothly with `shift`.
template <class F, class Tap, class Valid>
Vec2<F> last_valid(const Tap& tap, Vec2<F> shift, F share_there, Valid&& valid) {
  constexpr int kSteps = 8, kHalvings = 6;
  F low = F(0), high = F(1), share_low = F(1), share_high = share_there;
  F found = F(0);
  steps<F>(1, kSteps, [&](auto i) {
    const F t = Loop<F>::ratio(kSteps - i, kSteps);
    const F share = valid_share(tap, t * shift, valid);
    const auto open = found < F(0.5);
    const auto good = share >= F(0.5);
    low = select(open && good, t, low);
    share_low = select(open && good, share, share_low);
    high = select(open && !good, t, high);
    share_high = select(open && !good, share, share_high);
    found = select(good, F(1), found);
    return found < F(0.5);
  });
  repeat<F>(kHalvings, [&] {
    const F t = F(0.5) * (low + high);
    const F share = valid_share(tap, t * shift, valid);
    const auto good = share >= F(0.5);
    low = select(good, t, low);
    share_low = select(good, share, share_low);
    high = select(good, high, t);
    share_high = select(good, share_high, share);
  });
  const F fall = share_low - share_high;
  const F t = low + (high - low) * saturate((share_low - F(0.5)) / max(fall, F(1e-6)));
  // On steps wider than a texel the secant may end at a place without valid weight.
  const auto lands = valid_share(tap, t * shift, valid) > F(0.25);
  return select(lands, t, low) * shift;
}

/// The replacement for missing texels where `taps.made_up` holds: see valid_taps().
template <class F, class Tap, class Taps, class Valid, class Bearable, class Never>
LIMPID_INLINE void make_up(const Tap& tap, Vec2<F> shift, Valid&& valid, Bearable&& bearable,
                           Never&& never, Taps& taps) {
  const Vec2<F> shortened =
      never(taps.made_up) ? Vec2<F>{F(0), F(0)} : last_valid(tap, shift, taps.share, valid);
  taps.place = select(taps.share + taps.filled >= F(0.5), shift, shortened);
  taps.shortened = tap.quad(shortened);
  // Half of the weight is valid there, unless no place on the line is.
  const Four<F> good = valid(taps.shortened), last_resort = bearable(taps.shortened);
  F share = F(0), valid_weight = F(0);
  for (int k = 0; k < 4; ++k) share = share + taps.shortened.weight(k) * good[k];
  const auto found = share > F(0.25);
  for (int k = 0; k < 4; ++k) {
    const F counts = select(found, good[k], last_resort[k]);
    taps.weight_shortened.at[k] = taps.shortened.weight(k) * counts;
    valid_weight = valid_weight + taps.weight_shortened[k];
  }
  // The replacement counts alone if no texel is bearable.
  const auto alone = taps.filled > F(0) && valid_weight < F(1e-6);
  taps.filled = select(alone, F(1) - taps.share, taps.filled);
  const F scale = max(F(1) - taps.share - taps.filled, F(0)) / max(valid_weight, F(1e-6));
  for (int k = 0; k < 4; ++k) {
    taps.weight_shortened.at[k] = select(taps.made_up, scale * taps.weight_shortened[k], F(0));
  }
}

/// The taps for a lookup at `shift`. The share fill(lanes) of the missing weight is left to the
/// caller, as `filled`. If no place on the line is `valid`, a `bearable` texel replaces it: the
/// pixel's own texel always is bearable. If never(lanes) shows that no place is valid for these
/// lanes, the search is skipped.
template <class F, class Tap, class Valid, class Bearable, class Fill, class Never>
auto valid_taps(const Tap& tap, Vec2<F> shift, Valid&& valid, Bearable&& bearable, Fill&& fill,
                Never&& never) {
  using Quad = decltype(tap.quad(shift));
  const Quad there = tap.quad(shift);
  ValidTaps<F, Quad> taps{there, there, {}, {}, F(0), F(0), shift, {}};
  const Four<F> valid_there = valid(there);
  for (int k = 0; k < 4; ++k) {
    taps.weight_there.at[k] = there.weight(k) * valid_there[k];
    taps.share = taps.share + taps.weight_there[k];
    taps.weight_shortened.at[k] = F(0);
  }
  auto whole = taps.share > F(1 - 1e-6);
  taps.made_up = !whole;
  if_any(taps.made_up, [&] {
    const F fills = fill(!whole);
    taps.filled = select(whole, F(0), fills * max(F(1) - taps.share, F(0)));
    whole = whole || fills >= F(1);
    taps.made_up = !whole;
    if_any(taps.made_up, [&] { make_up<F>(tap, shift, valid, bearable, never, taps); });
  });
  return taps;
}

/// Taps without weight, for callers that decide later.
template <class F, class Tap>
LIMPID_INLINE auto no_taps(const Tap& tap, Vec2<F> shift) {
  using Quad = decltype(tap.quad(shift));
  const Quad there = tap.quad(shift);
  const Four<F> none{F(0), F(0), F(0), F(0)};
  return ValidTaps<F, Quad>{there, there, none, none, F(0), F(0), shift, F(0) > F(0)};
}

template <class F, class Tap, class Valid>
auto valid_taps(const Tap& tap, Vec2<F> shift, Valid&& valid) {
  return valid_taps(
      tap, shift, valid, valid, [](const auto&) { return F(0); },
      [](const auto&) { return false; });
}

}  // namespace limpid
