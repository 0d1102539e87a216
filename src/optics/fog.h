#pragma once
#include "limpid/core/number.h"

namespace limpid {

/// Share of the bottom's color that survives a linear fog: 1 - sat(density d - offset), "Realistic
/// Water". 1 means clear. d = +inf counts as the largest finite number, so that density 0 stays
/// clear at the sky. Not physical: a kink at both ends, one number for all channels.
template <class F>
LIMPID_INLINE F linear_fog(F distance, F density, F offset) {
  return F(1) - saturate(density * min(distance, F(3e38)) - offset);
}

}  // namespace limpid
