#pragma once
#include "complete/bottom_plane.h"

namespace limpid {

/// off_frame_lookups() without the share, from every `step`-th pixel at an edge.
OffFrameLookups off_frame_sides(const BottomPlane& bottom, const Frame& frame, const Pass& pass,
                                int step);

}  // namespace limpid
