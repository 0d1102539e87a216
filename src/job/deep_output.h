#pragma once
#include <array>

#include "limpid/core/frame.h"
#include "limpid/core/plane.h"
#include "limpid/core/scene.h"
#include "limpid/plan/plan.h"
#include "limpid/run/target.h"

namespace limpid {

/// The AOVs from which a deep file of the water is made.
inline constexpr Aov kDeepAovs[] = {Aov::kInScatter, Aov::kTransmittance, Aov::kPath,
                                    Aov::kSurfaceDepth};

/// Front and back of the water on the straight ray of each pixel, in eye depth. The front is +inf
/// on dry pixels; the back is always finite, and equals the front where there is no sample.
struct WaterExtent {
  Plane front, back;
  std::array<Plane, 3> in_scatter;  ///< of whole pixels, also where an object covers a part
};

/// From the AOVs path, surface_depth and in_scatter of a frame that was run, and its uncovered; as
/// OutputChoice::deep defines it.
WaterExtent water_extent(const Plan& plan, const Frame& frame, const Scene& scene,
                         const Target& target);

}  // namespace limpid
