#pragma once
#include "limpid/run/target.h"

namespace limpid::bench {

/// |difference| of two pictures over all pixels and channels, with white = 1; NaN counts as an
/// infinite difference.
struct PictureError {
  double mean = 0, p9999 = 0, max = 0;
};
PictureError error_of(const Target& judge, const Target& got);

}  // namespace limpid::bench
