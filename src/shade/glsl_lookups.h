#pragma once
#include <string>

#include "shade/glsl.h"
#include "shade/program.h"

namespace limpid {

/// What the statements of a GlslBody call: lookups in planes and textures, and the functions that
/// GLSL lacks or leaves to the driver. They look up as run/plain_taps.h and op/plain_texture.h do,
/// in float, with places counted from the pixel. The declarations that they read come first in the
/// shader: `limpid` (the uniform block), samplers limpid_ROLE and those of textures.
/// Where textures are gathered, limpid.texel_NAME has the size of a texel, and for planes 1 less
/// the corner of their window; rows have four values to a texel. `packed_map`: the wave map is of
/// bytes.
std::string glsl_lookups(const GlslNeeds& needs, Gathered gathered, bool packed_map);

/// Names of samplers.
std::string plane_sampler(PlaneId plane);
std::string texture_sampler(int texture);

}  // namespace limpid
