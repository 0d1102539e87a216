#pragma once
#include "limpid/core/number.h"

namespace limpid {

/// Whether looks that do not wait for one another are nearly free, as with lanes on a CPU, which
/// waits for each of them to come from memory.
template <class F>
inline constexpr bool kLooksAhead = false;

/// An interval at whose low end something does not hold, and does at its high end.
template <class F>
struct Bracket {
  F low, high;
};

/// Halved `times` times, holds(t) at the middle saying which half. Ahead, both quarters are looked
/// at together with the middle, and one of them for nothing: two halvings in the time of one, to
/// the same bits.
template <class F, class Holds>
LIMPID_INLINE Bracket<F> halve(Bracket<F> at, int times, Holds&& holds) {
  const auto once = [&] {
    const F middle = F(0.5) * (at.low + at.high);
    const auto hit = holds(middle);
    at = {select(hit, at.low, middle), select(hit, middle, at.high)};
  };
  if constexpr (kLooksAhead<F>) {
    repeat<F>(times / 2, [&] {
      const F middle = F(0.5) * (at.low + at.high);
      const F lower = F(0.5) * (at.low + middle), upper = F(0.5) * (middle + at.high);
      const auto in_middle = holds(middle), in_lower = holds(lower), in_upper = holds(upper);
      const F low = select(in_middle, at.low, middle), high = select(in_middle, middle, at.high);
      const F quarter = select(in_middle, lower, upper);
      const auto hit = (in_middle && in_lower) || (!in_middle && in_upper);
      at = {select(hit, low, quarter), select(hit, quarter, high)};
    });
    repeat<F>(times % 2, once);
  } else {
    repeat<F>(times, once);
  }
  return at;
}

}  // namespace limpid
