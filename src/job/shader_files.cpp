#include "limpid/files/exr/exr_writer.h"
#include "limpid/job/shader.h"

#include "files/atomic_file.h"
#include "files/exr/exr_whole.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;

/// One channel of the texture, with texel (0, 0) at the corner of the plane's window.
View<const float> channel_of(const ShaderTexture& texture, int k, const Frame* frame,
                             const Rect& window) {
  if (texture.source == ShaderTexture::Source::kPlanes) {
    View<const float> plane = frame->plane(plane_after(role_named(texture.role).first, k));
    plane.window = window;
    return plane;
  }
  const std::ptrdiff_t step = texture.channels;
  return {texture.texels.data() + k, step, step * texture.width, window};
}

ExrOutput picture_of(const ShaderTexture& texture, const Frame* frame) {
  const char* names[] = {"R", "G", "B", "A"};
  ExrOutput output;
  output.display = output.data = rect_of({texture.width, texture.height});
  for (int k = 0; k < texture.channels; ++k) {
    output.channels.push_back({texture.channels == 1 ? "Y" : names[k],
                               channel_of(texture, k, frame, output.data), false});
  }
  return output;
}

}  // namespace

std::vector<fs::path> write_shader(const fs::path& path, const ShaderText& shader,
                                   ShaderLanguage language, const Frame* frame) {
  const std::string text = in_language(shader, language), json = to_json(shader);
  AtomicFiles files;
  std::vector<fs::path> paths;
  const auto add = [&](const std::string& ending) -> const fs::path& {
    return paths.emplace_back(path.string() + ending);
  };
  files.add(add("")).write(text);
  files.add(add(".json")).write(json);
  for (const ShaderTexture& texture : shader.textures()) {
    if (texture.source != ShaderTexture::Source::kMade && !frame) continue;
    write_exr(files, add("." + texture.name + ".exr"), picture_of(texture, frame));
  }
  files.commit();
  return paths;
}

}  // namespace limpid
