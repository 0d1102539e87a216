#pragma once
#include "limpid/core/executor.h"

#include "show/shown.h"

namespace limpid {

/// The largest difference of a pixel's channels on the color ramp, from 0 to 1/4 at exposure 0,
/// halved with each stop.
Shown shown_difference(const ShownViews& a, const ShownViews& b, double exposure,
                       Executor& executor);

}  // namespace limpid
