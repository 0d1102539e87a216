#include "llvmpipe_chain.h"

#include <span>
#include <string>

#include <glm/gtc/type_ptr.hpp>

#include "gl_context.h"
#include "interleaved.h"
#include "llvmpipe_shader.h"

namespace limpid::bench {
namespace {

struct Uniforms {
  GLuint program;

  GLint at(const char* name) const { return glGetUniformLocation(program, name); }
  void set(const char* name, double value) const {
    glUniform1f(at(name), static_cast<float>(value));
  }
  void set(const char* name, const glm::dvec2& value) const {
    glUniform2fv(at(name), 1, glm::value_ptr(glm::vec2(value)));
  }
  void set(const char* name, const glm::dvec3& value) const {
    glUniform3fv(at(name), 1, glm::value_ptr(glm::vec3(value)));
  }
  void set(const char* name, const glm::dmat3& value) const {
    glUniformMatrix3fv(at(name), 1, GL_FALSE, glm::value_ptr(glm::mat3(value)));
  }
};

void set_numbers(const Uniforms& to, const RealisticNumbers& n) {
  const glm::dvec2 texel = 1.0 / glm::dvec2(n.size.width, n.size.height);
  to.set("texel", texel);
  to.set("refract_shift", n.refract_shift * texel);
  to.set("prism_shift", n.prism_shift * texel);
  to.set("mirror_shift", n.mirror_shift * texel);
  to.set("ray", n.ray);
  to.set("ray_dx", n.ray_dx);
  to.set("ray_dy", n.ray_dy);
  to.set("map_u", n.map_u);
  to.set("map_v", n.map_v);
  for (int i = 0; i < 4; ++i) {
    to.set(("map_begin[" + std::to_string(i) + "]").c_str(), n.map_begin[i]);
  }
  to.set("blend", n.blend);
  to.set("blend_begin", n.blend_begin);
  to.set("tilt_x", n.tilt_x);
  to.set("tilt_y", n.tilt_y);
  to.set("fog_density", n.fog_density);
  to.set("fog_offset", n.fog_offset);
  to.set("fog_alpha", n.fog_alpha);
  to.set("fog_color", n.fog_color);
  to.set("shadow_strength", n.shadow_strength);
  to.set("rim_power", n.rim_power);
  to.set("sun_power", n.sun_power);
  to.set("sun_direction", n.sun_direction);
  to.set("sun_color", n.sun_color);
}

/// One or three planes as the texture of the next unit.
void add_texture(const Uniforms& uniforms, const char* name, int unit,
                 std::span<const View<const float>> planes, GLint filter, GLint wrap) {
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(GL_TEXTURE_2D, texture);
  const bool rgb = planes.size() == 3;
  const Rect& w = planes[0].window;
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexImage2D(GL_TEXTURE_2D, 0, rgb ? GL_RGBA32F : GL_R32F, w.width(), w.height(), 0,
               rgb ? GL_RGB : GL_RED, GL_FLOAT, interleaved(planes).data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap);
  glUniform1i(uniforms.at(name), unit);
}

}  // namespace

LlvmpipeChain::LlvmpipeChain(const RealisticNumbers& numbers, const Frame& frame)
    : size_(numbers.size) {
  const Uniforms uniforms{use_program(kRealisticVertex, kRealisticFragment)};
  use_target(size_, false);
  set_numbers(uniforms, numbers);
  const auto planes = [&](PlaneId first, std::size_t count) {
    return std::span(frame.planes).subspan(static_cast<std::size_t>(index_of(first)), count);
  };
  const GLint edge = GL_CLAMP_TO_EDGE;
  add_texture(uniforms, "color_texture", 0, planes(PlaneId::kColorR, 3), GL_LINEAR, edge);
  add_texture(uniforms, "reflection_texture", 1, planes(PlaneId::kReflectionR, 3), GL_LINEAR, edge);
  add_texture(uniforms, "map_texture", 2, frame.wave_map.channels, GL_LINEAR, GL_REPEAT);
  add_texture(uniforms, "depth_texture", 3, planes(PlaneId::kDepth, 1), GL_NEAREST, edge);
  add_texture(uniforms, "surface_texture", 4, planes(PlaneId::kSurfaceDepth, 1), GL_NEAREST, edge);
  add_texture(uniforms, "shadow_texture", 5, planes(PlaneId::kShadow, 1), GL_LINEAR, edge);
  GLuint array = 0;
  glGenVertexArrays(1, &array);
  glBindVertexArray(array);
  expect_gl(glGetError() == GL_NO_ERROR, "loading the plate");
}

void LlvmpipeChain::draw() {
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glFinish();
}

std::vector<float> LlvmpipeChain::picture() const {
  return read_planes({GL_RED, GL_GREEN, GL_BLUE}, size_);
}

}  // namespace limpid::bench
