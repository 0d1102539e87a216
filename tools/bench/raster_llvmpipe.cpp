#include "raster_llvmpipe.h"

#include <algorithm>
#include <cstdint>

#include <glm/gtc/type_ptr.hpp>

#include "gl_context.h"

namespace limpid::bench {
namespace {

constexpr const char* kVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
uniform mat4 clip_from_world;
out vec3 world;
out vec3 n;
out vec2 texel;
void main() {
  world = position;
  n = normal;
  texel = uv;
  gl_Position = clip_from_world * vec4(position, 1.0);
})";

constexpr const char* kFragment = R"(#version 330 core
in vec3 world;
in vec3 n;
in vec2 texel;
uniform sampler2D base_texture;
uniform vec3 eye, sun, sun_color, base_color, ambient, specular;
uniform float power;
out vec4 color;
void main() {
  vec3 normal = normalize(n), viewer = normalize(eye - world);
  float cosine = dot(normal, sun);
  vec3 c = base_color * texture(base_texture, texel).rgb;
  color = vec4(c * (ambient + clamp(cosine, 0.0, 1.0) * sun_color), 1.0);
  if (cosine > 0.0) {
    vec3 r = 2.0 * cosine * normal - sun;
    color.rgb += specular * pow(clamp(dot(r, viewer), 0.0, 1.0), power) * sun_color;
  }
})";

template <class T>
void fill(GLenum target, const std::vector<T>& data) {
  GLuint buffer = 0;
  glGenBuffers(1, &buffer);
  glBindBuffer(target, buffer);
  glBufferData(target, static_cast<GLsizeiptr>(data.size() * sizeof(T)), data.data(),
               GL_STATIC_DRAW);
}

template <class T>
void attribute(GLuint location, const std::vector<T>& data) {
  fill(GL_ARRAY_BUFFER, data);
  glVertexAttribPointer(location, sizeof(T) / sizeof(float), GL_FLOAT, GL_FALSE, 0, nullptr);
  glEnableVertexAttribArray(location);
}

}  // namespace

GlRasteriser::GlRasteriser(const RasterScene& scene) : size_(scene.view.display.size()) {
  const GLuint program = use_program(kVertex, kFragment);
  use_target(size_, true);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);

  const Mesh& mesh = scene.model.meshes[0];
  GLuint array = 0;
  glGenVertexArrays(1, &array);
  glBindVertexArray(array);
  attribute(0, mesh.positions);
  attribute(1, mesh.normals);
  attribute(2, mesh.uvs);
  fill(GL_ELEMENT_ARRAY_BUFFER, mesh.indices);
  indices_ = static_cast<int>(mesh.indices.size());

  const ModelTexture& texture = scene.model.textures[0];
  std::vector<std::uint8_t> bytes;
  for (float value : texture.rgba) bytes.push_back(static_cast<std::uint8_t>(value * 255 + 0.5f));
  GLuint name = 0;
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, texture.width, texture.height, 0, GL_RGBA,
               GL_UNSIGNED_BYTE, bytes.data());
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);

  const auto color = [&](const char* uniform, double r, double g, double b) {
    glUniform3f(glGetUniformLocation(program, uniform), static_cast<float>(r),
                static_cast<float>(g), static_cast<float>(b));
  };
  const Camera& camera = scene.view.camera;
  const glm::mat4 clip_from_world(camera.projection * camera.view);
  glUniformMatrix4fv(glGetUniformLocation(program, "clip_from_world"), 1, GL_FALSE,
                     glm::value_ptr(clip_from_world));
  const glm::dvec3 eye = camera.eye(), sun = scene.lighting.sun.direction;
  const Material& m = scene.model.materials[0];
  color("eye", eye.x, eye.y, eye.z);
  color("sun", sun.x, sun.y, sun.z);
  color("sun_color", scene.lighting.sun.color.r, scene.lighting.sun.color.g,
        scene.lighting.sun.color.b);
  color("base_color", m.base_color.r, m.base_color.g, m.base_color.b);
  color("ambient", m.ambient.r, m.ambient.g, m.ambient.b);
  color("specular", m.specular.r, m.specular.g, m.specular.b);
  glUniform1f(glGetUniformLocation(program, "power"), static_cast<float>(m.power));
  const Rgb<double>& sky = scene.model.background;
  glClearColor(static_cast<float>(sky.r), static_cast<float>(sky.g), static_cast<float>(sky.b), 1);
  expect_gl(glGetError() == GL_NO_ERROR, "loading the scene");
}

void GlRasteriser::draw() {
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glDrawElements(GL_TRIANGLES, indices_, GL_UNSIGNED_INT, nullptr);
  glFinish();
}

std::vector<float> GlRasteriser::picture() const {
  std::vector<float> planes = read_planes({GL_RED, GL_GREEN, GL_BLUE, GL_DEPTH_COMPONENT}, size_);
  const std::ptrdiff_t width = size_.width, height = size_.height;
  for (int p = 0; p < 4; ++p) {  // the top row is to come first
    float* plane = planes.data() + p * width * height;
    for (std::ptrdiff_t y = 0; y < height / 2; ++y) {
      std::swap_ranges(plane + y * width, plane + (y + 1) * width,
                       plane + (height - 1 - y) * width);
    }
  }
  return planes;
}

}  // namespace limpid::bench
