#pragma once
#include <Imath/half.h>

#include "load/half_bits.h"

namespace limpid {

/// Finite values beyond the largest half become it, inf stays inf.
inline half half_of(float value) {
  half rounded;
  rounded.setBits(half_bits_of(value));
  return rounded;
}

}  // namespace limpid
