#pragma once
#include <string>

#include "shade/glsl.h"

namespace limpid {

/// What the statements of a GlslBody call: lookups in planes and textures, and the functions that
/// GLSL lacks or leaves to the driver. They look up as run/plain_taps.h and op/plain_texture.h do,
/// in float, with places counted from the pixel. The declarations that they read come first in the
/// shader: `limpid` (the uniform block), samplers limpid_ROLE and those of textures.
std::string glsl_lookups(const GlslNeeds& needs);

/// Names of samplers.
std::string plane_sampler(PlaneId plane);
std::string texture_sampler(int texture);

}  // namespace limpid
