#pragma once
#include "limpid/compare/error_map.h"

#include "compare/color_grids.h"

namespace limpid {

/// The map as it is handed out, +inf where the pictures were not alike in having numbers at all.
ErrorMap error_map_of(const Grid<float>& error, const CleanPair& pictures);

}  // namespace limpid
