#pragma once
#include "judge/compare/color_grids.h"
#include "judge/compare/error_map.h"

namespace limpid {

/// The map for the caller, +inf at mismatches.
ErrorMap error_map_of(const Grid<float>& error, const CleanPair& pictures);

}  // namespace limpid
