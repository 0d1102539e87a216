#pragma once
#include <vector>

#include <glm/vec4.hpp>

#include "limpid/raster/model.h"

#include "raster/pyramid.h"
#include "raster/raster_job.h"

namespace limpid::raster {

/// A material in the form of the stages, on a mesh with these vertex colors, if any. Throws Error
/// for indices out of range.
MaterialView material_view(const Material& material, const Model& model,
                           const std::vector<Pyramid>& pyramids,
                           const std::vector<glm::vec4>& colors);

}  // namespace limpid::raster
