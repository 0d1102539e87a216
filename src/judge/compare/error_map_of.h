#pragma once
#include "judge/compare/color_grids.h"
#include "judge/compare/error_map.h"

namespace limpid {

/// The map as it is handed out, +inf where the pictures were not alike in having numbers at all.
ErrorMap error_map_of(const Grid<float>& error, const CleanPair& pictures);

}  // namespace limpid
