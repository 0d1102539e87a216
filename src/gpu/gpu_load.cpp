#include "gpu/gpu_load.h"

#include <cstdio>

#include "limpid/core/error.h"

#include "complete/completer.h"

namespace limpid {

ShaderOptions compute_shader(const std::vector<Aov>& list) {
  ShaderOptions options;
  options.stage = ShaderOptions::Stage::kCompute;
  for (const Aov aov : list) {
    if (aovs()[static_cast<std::size_t>(aov)].planes.empty()) options.aovs.push_back(aov);
  }
  return options;
}

std::string gpu_load_text(const Plan& plan, const Scene& scene, const ShaderProgram& program) {
  std::size_t there = program.block.size();
  for (const ProgramTexture& texture : program.textures) {
    const std::size_t texels = static_cast<std::size_t>(texture.width) * texture.height;
    there += texels * (texture.channels == 1 ? 1 : 4) * sizeof(float);
  }
  const std::size_t pixels = static_cast<std::size_t>(program.work.area());
  const std::size_t back = program.outputs.size() * pixels * 4 * sizeof(float);
  char carried[160];
  std::snprintf(carried, sizeof carried,
                "on the GPU  shader %s of %zu numbers and %zu textures; at most %.1f MB to the "
                "device and %.1f MB back\n",
                program.id.c_str(), program.numbers.size(), program.textures.size(),
                1e-6 * static_cast<double>(there), 1e-6 * static_cast<double>(back));
  const std::vector<std::string> made = Completer::made_of_pixels(plan, scene.sky.has_value());
  return std::string(carried) + "on the CPU  " +
         (made.empty() ? "no step that needs pixels" : join(made)) + "\n";
}

}  // namespace limpid
