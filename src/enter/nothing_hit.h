#pragma once
#include "limpid/enter/sanitise.h"

namespace limpid {

/// Gives pixels that the source marks as "nothing hit" (DepthSource::nothing and ::uncovered) the
/// value with that meaning in a plane of its kind.
void mark_nothing_hit(const View<float>& plane, const DepthSource& source);

/// Whether any of `count` numbers, `stride` floats apart, is this one.
bool row_has(float value, const float* row, std::ptrdiff_t stride, int count);

}  // namespace limpid
