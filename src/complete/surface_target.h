#pragma once
#include <string>

#include "limpid/core/plane.h"

#include "op/raised_water.h"

namespace limpid {

/// One row of DisplacedSurface, compiled for one instruction set.
struct SurfaceTarget {
  void (*row)(const WaterView& view, const RaisedWater<float>& water, int y,
              const View<float>& depth);
};

/// For `simd` as in FusedOptions.
const SurfaceTarget& surface_target(const std::string& simd);

}  // namespace limpid
