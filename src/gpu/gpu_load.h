#pragma once
#include <string>
#include <vector>

#include "limpid/plan/plan.h"

#include "shade/program.h"

namespace limpid {

/// Options of a compute shader for the picture and those of these AOVs that are not planes of the
/// frame.
ShaderOptions compute_shader(const std::vector<Aov>& aovs);

/// The work of a frame for GPU and CPU, two lines: its shader, the transfers in both directions,
/// and the completers before it.
std::string gpu_load_text(const Plan& plan, const Scene& scene, const ShaderProgram& program);

}  // namespace limpid
