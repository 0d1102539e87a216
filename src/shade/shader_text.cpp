#include "limpid/shade/shader_text.h"

#include "complete/completer.h"
#include "plan/pass_of.h"
#include "shade/program.h"

namespace limpid {
namespace {

/// With its values, unless the host has them.
ShaderTexture texture_of(ProgramTexture& texture) {
  ShaderTexture made = std::move(static_cast<ShaderTexture&>(texture));
  if (made.source == ShaderTexture::Source::kPlanes) return made;
  const std::size_t row = static_cast<std::size_t>(made.channels) * made.width;
  made.texels.resize(row * made.height);
  for (int y = 0; y < made.height; ++y) {
    texture.fill(y, made.texels.data() + row * y, made.channels);
  }
  return made;
}

}  // namespace

ShaderText::ShaderText(const Plan& plan, const Frame& frame, const Scene& scene,
                       const ShaderOptions& options)
    : options_(options) {
  const std::unique_ptr<Executor> serial = make_executor(1);
  Completer completer;
  const Frame completed = completer.complete(plan, frame, pass_of(plan, scene, frame), *serial);
  Pass pass = pass_of(plan, scene, completed);
  pass.plate_waves = completer.plate_waves();
  if (!plan.reads_environment) pass.environment = {};
  ShaderProgram made = program_of(plan, frame, completed, pass, options);
  for (ProgramTexture& texture : made.textures) textures_.push_back(texture_of(texture));
  text_ = std::move(made.text);
  id_ = std::move(made.id);
  block_binding_ = made.block_binding;
  block_ = std::move(made.block);
  numbers_ = std::move(made.numbers);
  outputs_ = std::move(made.outputs);
  work_ = made.work;
  group_ = made.group;
}

}  // namespace limpid
