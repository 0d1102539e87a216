#pragma once
#include "limpid/core/frame.h"
#include "limpid/core/scene.h"
#include "limpid/ops/look.h"

#include "shade/program.h"

namespace limpid::bench {

/// The rival's shader of the look `realistic` (llvmpipe_shader.h) for Vulkan: the same text, with a
/// thread per pixel instead of a fragment.
ShaderProgram realistic_program(const Look& look, const Frame& frame, const Scene& scene);
/// The name of the texture that tiles.
inline constexpr const char* kRealisticMap = "map_texture";

}  // namespace limpid::bench
