#pragma once
#include <string>
#include <vector>

#include "limpid/plan/plan.h"

#include "shade/program.h"

namespace limpid {

/// Of a compute shader that makes the picture and, of these AOVs, those that are not planes of the
/// frame.
ShaderOptions compute_shader(const std::vector<Aov>& aovs);

/// What a frame asks of a GPU and of the CPU beside it, two lines: its shader, what is carried
/// there and back, and what is made before.
std::string gpu_load_text(const Plan& plan, const ShaderProgram& program);

}  // namespace limpid
