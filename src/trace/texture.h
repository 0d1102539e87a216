#pragma once
#include <glm/vec2.hpp>

#include "limpid/core/vec.h"

#include "raster/raster_job.h"

namespace limpid::trace {

/// A texture as the raster pass filters it: bilinear, repeating, in the mip level whose texels are
/// nearest in size to the sample's footprint, of which uv_dx and uv_dy are the sides. Footprints
/// that are not finite see the coarsest level.
Rgb<double> sample(const raster::PyramidView& texture, const glm::dvec2& uv,
                   const glm::dvec2& uv_dx, const glm::dvec2& uv_dy);

}  // namespace limpid::trace
