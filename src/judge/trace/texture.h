#pragma once
#include <glm/vec2.hpp>

#include "limpid/core/vec.h"

#include "raster/raster_job.h"

namespace limpid::trace {

/// A place in a texture, and the sides of the sample's footprint there.
struct TexturePlace {
  glm::dvec2 uv{0}, dx{0}, dy{0};
};

struct Texel {
  Rgb<double> color{1, 1, 1};
  double alpha = 1;
};

/// A texture filtered as in the raster pass: bilinear, in the mip level whose texel size is nearest
/// to the footprint. Footprints that are not finite get the coarsest level.
Texel sample(const raster::PyramidView& texture, const TextureLookup& lookup,
             const TexturePlace& place);

}  // namespace limpid::trace
