#include "realistic_program.h"

#include <cstring>
#include <string>

#include <glm/gtc/type_ptr.hpp>

#include "llvmpipe_shader.h"
#include "realistic_numbers.h"

namespace limpid::bench {
namespace {

/// A std140 block: each member lies at the next offset with the member's alignment.
class Block {
 public:
  explicit Block(ShaderProgram& program) : bytes_(program.block) {}
  void add(const glm::dvec3& v) { put(glm::value_ptr(glm::vec3(v)), 3, 16); }
  void add(const glm::dvec2& v, std::size_t alignment = 8) {
    put(glm::value_ptr(glm::vec2(v)), 2, alignment);
  }
  void add(double value) {
    const auto number = static_cast<float>(value);
    put(&number, 1, 4);
  }
  void finish() { bytes_.resize((bytes_.size() + 15) / 16 * 16); }

 private:
  void put(const float* numbers, std::size_t count, std::size_t alignment) {
    const std::size_t at = (bytes_.size() + alignment - 1) / alignment * alignment;
    bytes_.resize(at + count * sizeof(float));
    std::memcpy(bytes_.data() + at, numbers, count * sizeof(float));
  }
  std::vector<std::byte>& bytes_;
};

void add_texture(ShaderProgram& to, std::string& declared, const std::string& name,
                 std::vector<View<const float>> views) {
  ProgramTexture texture;
  texture.name = name;
  texture.source =
      name == kRealisticMap ? ShaderTexture::Source::kMade : ShaderTexture::Source::kPlanes;
  texture.binding = static_cast<int>(to.textures.size()) + 1;
  texture.channels = static_cast<int>(views.size());
  texture.width = views[0].window.width(), texture.height = views[0].window.height();
  texture.fill = [views](int y, float* row, int step) {
    for (std::size_t k = 0; k < views.size(); ++k) {
      const Rect& w = views[k].window;
      for (int x = 0; x < w.width(); ++x) {
        row[std::ptrdiff_t{x} * step + static_cast<std::ptrdiff_t>(k)] =
            views[k].at(w.x0 + x, w.y0 + y);
      }
    }
  };
  declared += "layout(set = 0, binding = " + std::to_string(texture.binding) +
              ") uniform sampler2D " + name + ";\n";
  to.textures.push_back(std::move(texture));
}

/// The rival's main() as a function of a fragment.
std::string shade_text() {
  std::string text = kRealisticFragment;
  text.erase(0, text.find("void main()"));
  const auto replace = [&](const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
      text.replace(at, from.size(), to);
      at += to.size();
    }
  };
  replace("void main()", "void shade()");
  replace("gl_FragCoord", "fragment");
  return text;
}

}  // namespace

ShaderProgram realistic_program(const Look& look, const Frame& frame, const Scene& scene) {
  ShaderProgram made;
  made.work = frame.work();
  made.group = {16, 8};
  made.id = "the rival's";
  const RealisticNumbers n(look, frame, scene);
  const glm::dvec2 texel = 1.0 / glm::dvec2(n.size.width, n.size.height);
  Block block(made);
  for (const glm::dvec3& v : {n.ray, n.ray_dx, n.ray_dy, n.map_u, n.map_v, n.blend_begin, n.tilt_x,
                              n.tilt_y, n.fog_color, n.sun_direction, n.sun_color}) {
    block.add(v);
  }
  for (int c = 0; c < 3; ++c) block.add(n.blend[c]);
  for (const glm::dvec2& begin : n.map_begin) block.add(begin, 16);
  block.add(texel, 16);  // behind an array
  for (const glm::dvec2& shift : {n.refract_shift, n.prism_shift, n.mirror_shift}) {
    block.add(shift * texel);
  }
  for (const double x :
       {n.fog_density, n.fog_offset, n.fog_alpha, n.shadow_strength, n.rim_power, n.sun_power}) {
    block.add(x);
  }
  block.finish();
  std::string samplers;
  const auto planes = [&](PlaneId first, int count) {
    std::vector<View<const float>> views;
    for (int k = 0; k < count; ++k) views.push_back(frame.plane(plane_after(first, k)));
    return views;
  };
  add_texture(made, samplers, "color_texture", planes(PlaneId::kColorR, 3));
  add_texture(made, samplers, "reflection_texture", planes(PlaneId::kReflectionR, 3));
  add_texture(made, samplers, kRealisticMap,
              {frame.wave_map.channels.begin(), frame.wave_map.channels.end()});
  add_texture(made, samplers, "depth_texture", planes(PlaneId::kDepth, 1));
  add_texture(made, samplers, "surface_texture", planes(PlaneId::kSurfaceDepth, 1));
  add_texture(made, samplers, "shadow_texture", planes(PlaneId::kShadow, 1));
  const int output = static_cast<int>(made.textures.size()) + 1;
  made.outputs.push_back({"color", 4, output});
  made.text =
      "#version 450\nlayout(local_size_x = 16, local_size_y = 8) in;\n"
      "layout(std140, set = 0, binding = 0) uniform Numbers {\n"
      "  vec3 ray, ray_dx, ray_dy, map_u, map_v, blend_begin, tilt_x, tilt_y, fog_color;\n"
      "  vec3 sun_direction, sun_color;\n  mat3 blend;\n  vec2 map_begin[4];\n"
      "  vec2 texel, refract_shift, prism_shift, mirror_shift;\n"
      "  float fog_density, fog_offset, fog_alpha, shadow_strength, rim_power, sun_power;\n};\n" +
      samplers + "layout(set = 0, binding = " + std::to_string(output) +
      ", rgba32f) writeonly uniform image2D picture;\nvec4 result;\nvec2 fragment;\n" +
      shade_text() + "\nvoid main() {\n  ivec2 at = ivec2(gl_GlobalInvocationID.xy);\n" +
      "  if (any(greaterThanEqual(at, imageSize(picture)))) return;\n" +
      "  fragment = vec2(at) + 0.5;\n  shade();\n  imageStore(picture, at, result);\n}\n";
  return made;
}

}  // namespace limpid::bench
