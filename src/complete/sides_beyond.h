#pragma once
#include "complete/bottom_plane.h"

namespace limpid {

/// look_beyond() without the share, from every `step`-th pixel at an edge.
Beyond sides_beyond(const BottomPlane& bottom, const Frame& frame, const Pass& pass, int step);

}  // namespace limpid
