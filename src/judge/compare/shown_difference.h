#pragma once
#include "limpid/core/executor.h"

#include "show/shown.h"

namespace limpid {

/// The largest difference of a pixel's channels on the color ramp, from 0 to 1/4 at exposure 0, to
/// half of that with each stop more.
Shown shown_difference(const ShownViews& a, const ShownViews& b, double exposure,
                       Executor& executor);

}  // namespace limpid
