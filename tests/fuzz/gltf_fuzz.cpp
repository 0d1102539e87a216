#include <string_view>

#include "fuzz/harness.h"
#include "load/gltf_model.h"

namespace limpid::fuzz {

void gltf(Bytes bytes) {
  Limits limits;
  limits.max_pixels = 1 << 18;
  limits.max_side = 4096;
  limits.max_memory = 64 << 20;
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  accepts([&] {
    const Model model = gltf_model(split_gltf(text, limits), "/nowhere", limits);
    for (const ModelTexture& texture : model.textures) {
      expect(texture.rgba.size() == 4ul * texture.width * texture.height,
             "a texture has four floats a texel");
    }
  });
}

}  // namespace limpid::fuzz
