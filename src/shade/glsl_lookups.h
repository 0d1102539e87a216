#pragma once
#include <string>

#include "shade/glsl.h"
#include "shade/program.h"

namespace limpid {

/// The functions called by a GlslBody: lookups in planes and textures, and functions that GLSL
/// lacks or leaves to the driver. They match run/plain_taps.h and op/plain_texture.h, in float,
/// with places relative to the pixel. The shader first declares what they read: `limpid` (the
/// uniform block), samplers limpid_ROLE and those of textures. For gathered textures,
/// limpid.texel_NAME has the size of a texel, and for planes 1 less the corner of their window;
/// the table of rows has four values per texel. `packed_map`: the wave map has bytes.
/// `summed_quads`: the corners of four texels come from sums, not from floor().
std::string glsl_lookups(const GlslNeeds& needs, Gathered gathered, bool packed_map,
                         bool summed_quads);

/// Names of samplers.
std::string plane_sampler(PlaneId plane);
std::string texture_sampler(int texture);

}  // namespace limpid
