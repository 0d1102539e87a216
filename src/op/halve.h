#pragma once
#include "limpid/core/number.h"

namespace limpid {

/// Whether a second independent lookup is nearly free, as for SIMD lanes on a CPU, where each
/// lookup waits for memory.
template <class F>
inline constexpr bool kLooksAhead = false;

/// An interval: a condition does not hold at its low end, and holds at its high end.
template <class F>
struct Bracket {
  F low, high;
};

/// Bisects `times` times by holds(t) at the middle. Where kLooksAhead<F>, both quarters are tested
/// together with the middle, one of them in vain: two bisections in the time of one, with the same
/// bits as result.
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
